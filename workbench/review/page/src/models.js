/** three.js objects of a surface: its patches, its deviation, its mesh lines and what changed in it. */
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshLambertMaterial } from 'three';
import { deviationRamp, patchColours, rampColour } from './colours.js';

const attribute = (values, size) => new BufferAttribute(values, size);

function geometryOf(surface) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', attribute(surface.points, 3));
  geometry.setAttribute('normal', attribute(surface.normals, 3));
  geometry.setIndex(attribute(surface.index, 1));
  return geometry;
}

/** Openings and caps are flat: shaded by their faces, they show no false curvature at the rim. */
const patchMaterial = (colour, kind, vertexColors) => new MeshLambertMaterial({ color: vertexColors ? 0xffffff : colour, vertexColors, side: DoubleSide, flatShading: kind !== 'wall' });

/** Colours of vertices. @param {(value: number) => number[]} colourOf red, green, blue in [0, 255] */
function vertexColours(values, colourOf) {
  const colours = new Uint8Array(3 * values.length);
  const colour = new Color();
  for (let i = 0; i < values.length; ++i) {
    const [r, g, b] = colourOf(values[i]);
    colour.setRGB(r / 255, g / 255, b / 255, 'srgb');
    colours.set([255 * colour.r, 255 * colour.g, 255 * colour.b].map(Math.round), 3 * i);
  }
  return new BufferAttribute(colours, 3, true);
}

/**
 * Makes the drawable parts of a surface. They share its vertices on the graphics card.
 * @param surface as `makeSurface` returns it
 * @param {{colours?: number[], measure?: {values: Float32Array, colourOf: Function}}} look colours of the patches; a measure colours the wall
 * @returns {{group: Group, patches: Mesh, set: Function, dispose: Function}}
 */
export function makeModel(surface, { colours = patchColours(surface.patches), measure = null } = {}) {
  const geometry = geometryOf(surface);
  if (measure) geometry.setAttribute('color', vertexColours(measure.values, measure.colourOf));
  surface.groups.forEach((group) => geometry.addGroup(3 * group.start, 3 * group.count, group.patch));
  const materials = surface.patches.map((patch, i) => patchMaterial(colours[i], patch.kind, Boolean(measure) && patch.kind === 'wall'));
  const patches = new Mesh(geometry, materials);
  const group = new Group().add(patches);
  const extra = {};
  let deviation = null;
  const shared = (index) => {
    const own = new BufferGeometry();
    for (const name of ['position', 'normal']) own.setAttribute(name, geometry.getAttribute(name));
    own.setIndex(index);
    return own;
  };
  const addExtra = (name, mesh) => { extra[name] = mesh; mesh.visible = false; group.add(mesh); };
  return {
    group, patches, extra,
    addLines(colour) {
      if (!extra.lines) addExtra('lines', new Mesh(shared(geometry.index),
        new MeshLambertMaterial({ color: 0, emissive: colour, wireframe: true, transparent: true, opacity: 0.35 })));
    },
    addMarked(corners, colour) {
      addExtra('marked', new Mesh(shared(attribute(corners, 1)), new MeshLambertMaterial({
        color: colour, side: DoubleSide, transparent: true, opacity: 0.55, polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -1 })));
    },
    addGhost(corners, colour) {
      addExtra('ghost', new Mesh(shared(attribute(corners, 1)), new MeshLambertMaterial({
        color: colour, side: DoubleSide, transparent: true, opacity: 0.5 })));
    },
    setDeviation(values, { min, max }) { deviation = { values, colourOf: (value) => rampColour((value - min) / (max - min), deviationRamp(min)) }; },
    /** Whether there is a deviation; its colours are made when it is looked at, not with every edit. */
    deviation() {
      if (deviation && !extra.deviation) {
        const own = shared(geometry.index);
        own.setAttribute('color', vertexColours(deviation.values, deviation.colourOf));
        addExtra('deviation', new Mesh(own, new MeshLambertMaterial({ vertexColors: true, side: DoubleSide })));
      }
      return Boolean(deviation);
    },
    dispose() {
      for (const mesh of [patches, ...Object.values(extra)]) {
        mesh.geometry.dispose();
        [mesh.material].flat().forEach((material) => material.dispose());
      }
    },
  };
}

/** A translucent neighbouring structure. */
export function makeNeighbour(surface) {
  return new Mesh(geometryOf(surface), new MeshLambertMaterial({ color: 0x8f8fa0, transparent: true, opacity: 0.4, depthWrite: false, side: DoubleSide }));
}
