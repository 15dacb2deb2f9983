// The temperature of the wire on the part of the slider's way on which it is heated.

// Half a cosine between both temperatures, as Transformation.heated_to in solver/actuation.
function heatedTo(fraction, { startC, finishC }) {
  return startC + ((finishC - startC) * Math.acos(Math.max(-1, 1 - 2 * fraction))) / Math.PI;
}

function temperature(where, fraction, heating) {
  const { startC, finishC } = heating;
  if (where === 'flat') return 'any: the hoop holds it';
  if (where === 'cold') return `up to ${startC.toFixed(1)} °C`;
  if (where === 'hot') return `${finishC.toFixed(1)} °C or more`;
  if (where === 'being released') return 'not heated';
  if (fraction === null) return `${startC.toFixed(1)} to ${finishC.toFixed(1)} °C`;
  return `${heatedTo(fraction, heating).toFixed(1)} °C`;
}

// Marks below the slider: both ends of the heating, and a quarter, half and three quarters of it.
function degrees(states, heating) {
  const cold = states.findIndex((state) => state.stop === 'cold');
  const place = (share) => {
    const fraction = (1 - Math.cos(Math.PI * share)) / 2;
    const next = states.findIndex((state, k) => k > cold && state.austenite >= fraction);
    const [low, high] = [states[next - 1].austenite, states[next].austenite];
    return next - 1 + (fraction - low) / (high - low);
  };
  const known = states[cold].austenite !== null && states.length > cold + 2;
  return (known ? [0, 0.25, 0.5, 0.75, 1] : [0, 1]).map((share) => {
    const at = share === 0 ? cold : share === 1 ? states.length - 1 : place(share);
    const words = Number((heating.startC + share * (heating.finishC - heating.startC)).toFixed(1));
    return `<span style="left:${((100 * at) / (states.length - 1)).toFixed(2)}%">${words} °C</span>`;
  }).join('');
}
