// Reads packed arrays: base64 of little-endian numbers, reals as 16-bit numbers times a scale.
const ARRAYS = { int8: Int8Array, uint8: Uint8Array, int16: Int16Array, uint32: Uint32Array };

function unpack(packed) {
  const bytes = Uint8Array.from(atob(packed.data), (c) => c.charCodeAt(0));
  const whole = new ARRAYS[packed.type](bytes.buffer);
  return packed.scale === undefined ? whole : Float32Array.from(whole, (v) => v * packed.scale);
}
