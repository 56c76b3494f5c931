/** Colours that hold for readers with any colour vision: hues after Okabe and Ito, one ramp of falling lightness. */

/** Before is orange and dashed, after is blue and solid, wherever both are shown. */
export const BEFORE = 0xd55e00;
export const AFTER = 0x0072b2;

/** What was there before, beside a deviation map: a grey, as the map's own colours are taken. */
export const GHOST = 0x7c8796;

const WALL = 0xe3b3a2;
/** Green and blues, as the window and pictures have these roles. */
const INLET = 0x009e73;
const OUTLETS = [0x0072b2, 0x56b4e9];
const hex = (colour) => `#${colour.toString(16).padStart(6, '0')}`;

/** @param {{name, kind}[]} patches @returns {number[]} a colour for each */
export function patchColours(patches) {
  let outlets = 0;
  return patches.map(({ kind }) => {
    if (kind === 'wall') return WALL;
    if (kind === 'inlet') return INLET;
    if (kind === 'outlet') return OUTLETS[outlets++ % OUTLETS.length];
    return kind === 'cap' ? 0x8c8c94 : 0xb9a5d6;
  });
}

/** Of other structures, one after the other: apart from each other and from a vessel's wall. GLB files have the same, as kNeighbourColours of meshing/products/glb.cpp. */
const NEIGHBOURS = [0x8f8fc0, 0xd55e00, 0x009e73, 0xcc79a7, 0x56b4e9, 0xf0e442];
export const neighbourColour = (number) => NEIGHBOURS[number % NEIGHBOURS.length];

const RAMP = [[246, 243, 236], [252, 214, 132], [244, 157, 62], [214, 92, 36], [150, 38, 36], [78, 10, 34]];

/** Blue where the wall moved inwards, pale where it stayed, red where it moved outwards. */
const BOTH_WAYS = [[8, 48, 107], [33, 102, 172], [103, 169, 207], [246, 243, 236], [239, 138, 98], [178, 24, 43], [103, 0, 31]];

/** Of deviations from a least one on, which is negative if some are. */
export const deviationRamp = (min) => (min < 0 ? BOTH_WAYS : RAMP);

/** Colour of a share in [0, 1]: of the largest deviation, from pale to dark, or on another ramp. @returns {number[]} red, green, blue in [0, 255] */
export function rampColour(share, ramp = RAMP) {
  const x = Math.min(1, Math.max(0, share)) * (ramp.length - 1);
  const i = Math.min(ramp.length - 2, Math.floor(x));
  return ramp[i].map((low, k) => low + (x - i) * (ramp[i + 1][k] - low));
}

export const css = hex;
/** The ramp's colours in CSS, with commas, for a gradient. */
export const rampStops = (ramp = RAMP) => ramp.map((c) => `rgb(${c.join(' ')})`).join(', ');
/** CSS gradient of a ramp, upwards or to another side. */
export const rampGradient = (ramp = RAMP, side = 'top') => `linear-gradient(to ${side}, ${rampStops(ramp)})`;
