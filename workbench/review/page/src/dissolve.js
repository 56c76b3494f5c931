/** Two pictures of one camera, blended: what stays is steady, what changed fades over. */
import { Color, HalfFloatType, Mesh, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, WebGLRenderTarget } from 'three';

const VERTEX = 'varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }';
const FRAGMENT = `uniform sampler2D first; uniform sampler2D second; uniform float share; varying vec2 at;
void main() { gl_FragColor = mix(texture2D(first, at), texture2D(second, at), share); 
#include <colorspace_fragment>
}`;

export class Dissolve {
  constructor() {
    this.targets = [0, 1].map(() => new WebGLRenderTarget(1, 1, { samples: 4, type: HalfFloatType }));
    this.material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, depthTest: false,
      uniforms: { first: { value: this.targets[0].texture }, second: { value: this.targets[1].texture }, share: { value: 0 } } });
    this.scene = new Scene().add(new Mesh(new PlaneGeometry(2, 2), this.material));
    this.camera = new OrthographicCamera();
  }

  /** @param {Function[]} draws two functions that draw a picture each @param {number} share of the second, in [0, 1] */
  render(renderer, width, height, draws, share) {
    const ground = renderer.getClearColor(new Color());
    draws.forEach((draw, i) => {
      this.targets[i].setSize(width, height);
      renderer.setRenderTarget(this.targets[i]);
      renderer.setClearColor(ground);  // once more: a target takes it in linear values, the screen in sRGB
      renderer.clear();
      draw();
    });
    renderer.setRenderTarget(null);
    renderer.setClearColor(ground);
    this.material.uniforms.share.value = share;
    renderer.render(this.scene, this.camera);
  }
}
