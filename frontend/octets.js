/**
 * The one-reply form of a result: uint32 header length, JSON header, then little-endian arrays.
 *
 * @returns {{header: object, arrays: Object<string, {data: Float32Array, shape: number[], unit: string}>}}
 */
export function decodeResult(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const first = 4 + length; // a multiple of 4: the header is padded
  const arrays = {};
  for (const [name, { offset, shape, unit }] of Object.entries(header.arrays)) {
    const count = shape.reduce((product, n) => product * n, 1);
    arrays[name] = { data: new Float32Array(buffer, first + offset, count), shape, unit };
  }
  return { header, arrays };
}
