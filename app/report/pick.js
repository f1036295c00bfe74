// What lies under the cursor: one pixel is drawn with the number of mesh and vertex in place of a colour.
import { GLSL3, Color, DoubleSide, NearestFilter, ShaderMaterial, WebGLRenderTarget } from "three";

const vertexShader = `
flat out int number;
#include <common>
#include <morphtarget_pars_vertex>
void main() {
    #include <begin_vertex>
    #include <morphtarget_vertex>
    #include <project_vertex>
    number = gl_VertexID;
}`;
const fragmentShader = `
flat in int number;
uniform int mesh;
layout(location = 0) out highp vec4 code;
void main() {
    code = vec4(number & 255, number >> 8 & 255, number >> 16 & 255, mesh) / 255.0;
}`;

export class Picker {
    constructor(renderer) {
        this.renderer = renderer;
        this.target = new WebGLRenderTarget(1, 1, { minFilter: NearestFilter, magFilter: NearestFilter });
        this.materials = [];
        this.clear = new Color();
    }

    /**
     * x, y: shares of the camera's view from its upper left corner; points: what is not to be picked. { mesh, vertex } of
     * what is nearest there, or null.
     */
    pick(scene, camera, meshes, points, x, y) {
        const { renderer } = this,
            own = meshes.map(m => m.material),
            alpha = renderer.getClearAlpha(),
            shown = points.visible;
        meshes.forEach((mesh, i) => {
            this.materials[i] ??= new ShaderMaterial({
                glslVersion: GLSL3,
                vertexShader,
                fragmentShader,
                side: DoubleSide,
                uniforms: { mesh: { value: i + 1 } },
            });
            mesh.material = this.materials[i];
        });
        points.visible = false;
        renderer.getClearColor(this.clear);
        const side = 1 << 14; // as if the view had this many pixels each way, of which one is drawn
        camera.setViewOffset(side, side, Math.floor(x * side), Math.floor(y * side), 1, 1);
        renderer.setRenderTarget(this.target);
        renderer.setClearColor(0, 0);
        renderer.clear();
        renderer.render(scene, camera);
        const code = new Uint8Array(4);
        renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, code);
        renderer.setRenderTarget(null);
        renderer.setClearColor(this.clear, alpha);
        camera.clearViewOffset();
        points.visible = shown;
        meshes.forEach((mesh, i) => {
            mesh.material = own[i];
        });
        return code[3] ? { mesh: meshes[code[3] - 1], vertex: code[0] | (code[1] << 8) | (code[2] << 16) } : null;
    }
}
