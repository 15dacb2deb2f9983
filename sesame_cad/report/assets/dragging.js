// Mouse, pen and fingers: calls move(dx, dy, event, pinch) while something is held down.
function dragged(element, move, tapped) {
  const held = new Map();
  let travelled = 0;
  element.addEventListener('pointerdown', (event) => {
    if (!held.size) travelled = 0;
    held.set(event.pointerId, [event.clientX, event.clientY]);
    element.setPointerCapture(event.pointerId);
  });
  element.addEventListener('pointermove', (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const other = [...held].filter(([id]) => id !== event.pointerId).map(([, at]) => at)[0];
    const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
    held.set(event.pointerId, now);
    travelled += Math.hypot(now[0] - before[0], now[1] - before[1]);
    move(now[0] - before[0], now[1] - before[1], event, other ? apart(now) / apart(before) : null);
  });
  const release = (event) => {
    if (held.delete(event.pointerId) && event.type === 'pointerup' && travelled < 4 && tapped) tapped(event);
  };
  element.addEventListener('pointerup', release);
  element.addEventListener('pointercancel', release);
}
