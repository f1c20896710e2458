/** Three's materials, taught to place instances from a texture: by bones, or by place and facing alone. */
import type { DataTexture, Material } from "three";
import { JOINT_COUNT } from "../../core/skeleton/joints.ts";

export interface CrowdUniforms {
  uBones: { value: DataTexture };
  uLightness: { value: number };
}

const COMMON = `#include <common>
attribute float agent;
uniform highp sampler2D uBones;
uniform float uLightness;
varying float vLight;
vec4 crowdTexel(int k) { return texelFetch(uBones, ivec2(k, int(agent + 0.5)), 0); }`;

const BONES = `
attribute vec4 skinIndex;
attribute vec4 skinWeight;
mat4 crowdBone(float joint) {
  int k = 3 * int(joint + 0.5);
  vec4 a = crowdTexel(k); vec4 b = crowdTexel(k + 1); vec4 c = crowdTexel(k + 2);
  return mat4(a.x, b.x, c.x, 0.0, a.y, b.y, c.y, 0.0, a.z, b.z, c.z, 0.0, a.w, b.w, c.w, 1.0);
}
mat4 crowdMatrix() {
  return crowdBone(skinIndex.x) * skinWeight.x + crowdBone(skinIndex.y) * skinWeight.y
    + crowdBone(skinIndex.z) * skinWeight.z + crowdBone(skinIndex.w) * skinWeight.w;
}`;

const PLACE = `
mat4 crowdMatrix() {
  vec4 p = crowdTexel(${3 * JOINT_COUNT});
  float fz = crowdTexel(${3 * JOINT_COUNT + 1}).x;
  return mat4(fz, 0.0, -p.w, 0.0, 0.0, 1.0, 0.0, 0.0, p.w, 0.0, fz, 0.0, p.x, 0.0, p.z, 1.0);
}`;

/** Adds instancing to a material; the same program serves every crowd. */
export function crowdMaterial(material: Material, uniforms: CrowdUniforms, how: "bones" | "place"): void {
  material.customProgramCacheKey = () => `crowd ${how}`;
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, uniforms);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", COMMON + (how === "bones" ? BONES : PLACE))
      .replace(
        "#include <beginnormal_vertex>",
        "mat4 crowd = crowdMatrix();\nvec3 objectNormal = mat3(crowd) * normal;",
      )
      .replace(
        "#include <begin_vertex>",
        `${material.type === "MeshBasicMaterial" ? "mat4 crowd = crowdMatrix();\n" : ""}vec3 transformed = (crowd * vec4(position, 1.0)).xyz;
float h = fract(sin(agent * 12.9898) * 43758.5453);
vLight = 1.0 + uLightness * (2.0 * h - 1.0);${how === "place" ? "\ntransformed.y += 0.0015;" : ""}`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float vLight;")
      .replace("#include <color_fragment>", "#include <color_fragment>\ndiffuseColor.rgb *= vLight;");
  };
}
