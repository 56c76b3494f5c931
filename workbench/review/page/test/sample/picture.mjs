// Small shaded PNG pictures of a mesh, so that the sample has thumbnails without a graphics card.
import { deflateSync } from 'node:zlib';
import { minus, unit } from './vessel.mjs';

function crc(bytes) {
  let c = ~0;
  for (const byte of bytes) {
    c ^= byte;
    for (let k = 0; k < 8; ++k) c = c & 1 ? (c >>> 1) ^ 0xedb88320 : c >>> 1;
  }
  return ~c >>> 0;
}

function part(type, data) {
  const body = Buffer.concat([Buffer.from(type), data]);
  const out = Buffer.alloc(body.length + 8);
  out.writeUInt32BE(data.length, 0);
  body.copy(out, 4);
  out.writeUInt32BE(crc(body), body.length + 4);
  return out;
}

/** @param {Uint8Array} rgb width x height x 3 */
function png(rgb, width, height) {
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  const rows = Buffer.concat(Array.from({ length: height }, (_, y) =>
    Buffer.concat([Buffer.from([0]), Buffer.from(rgb.subarray(3 * width * y, 3 * width * (y + 1)))])));
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), part('IHDR', head), part('IDAT', deflateSync(rows)), part('IEND', Buffer.alloc(0))]);
}

/** Draws a mesh seen from +y, framed on a place; what `changed` holds for is coloured. @returns {string} data URL */
export function thumbnail(mesh, centre, radius, changed, size = 112) {
  const rgb = new Uint8Array(3 * size * size).fill(236);
  const depth = new Float32Array(size * size).fill(Infinity);
  const scale = size / (2 * radius);
  const screen = (p) => [(centre[0] - p[0]) * scale + size / 2, size / 2 - (p[2] - centre[2]) * scale, -p[1]];
  mesh.triangles.forEach((t, i) => {
    const [a, b, c] = t.map((v) => screen(mesh.points[v]));
    const [u, v] = [minus(b, a), minus(c, a)];
    const area = u[0] * v[1] - u[1] * v[0];
    if (Math.abs(area) < 1e-9) return;
    const light = Math.abs(unit([u[1] * v[2] * scale - u[2] * scale * v[1], u[2] * scale * v[0] - u[0] * v[2] * scale, area])[2]);
    const colour = (changed(i) ? [64, 140, 214] : [226, 170, 150]).map((x) => x * (0.35 + 0.65 * light));
    const low = (k, end) => Math.max(0, Math.min(end, Math.floor(Math.min(a[k], b[k], c[k]))));
    const high = (k, end) => Math.max(0, Math.min(end, Math.ceil(Math.max(a[k], b[k], c[k]))));
    for (let y = low(1, size); y < high(1, size); ++y) for (let x = low(0, size); x < high(0, size); ++x) {
      const [px, py] = [x + 0.5 - a[0], y + 0.5 - a[1]];
      const s = (px * v[1] - py * v[0]) / area, r = (u[0] * py - u[1] * px) / area;
      if (s < 0 || r < 0 || s + r > 1) continue;
      const z = a[2] + s * u[2] + r * v[2];
      if (z >= depth[y * size + x]) continue;
      depth[y * size + x] = z;
      rgb.set(colour, 3 * (y * size + x));
    }
  });
  return `data:image/png;base64,${png(rgb, size, size).toString('base64')}`;
}
