/** The room: a matt floor with a grid drawn in its shader, two walls that meet it in a cove, soft light. */
import {
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  Float32BufferAttribute,
  Fog,
  Group,
  HemisphereLight,
  LightProbe,
  Mesh,
  MeshStandardMaterial,
  PlaneGeometry,
  type Scene,
  SphericalHarmonics3,
} from "three";
import { ROOMS, type Theme } from "./tokens.ts";

/** Radius of the cove and distances of the walls, metres. */
const COVE = 0.09;
const BACK = 4.2;
const LEFT = 4.6;
const HEIGHT = 3.2;

/**
 * Light of the surroundings, the nine real spherical harmonics of the irradiance that three's RoomEnvironment gives (grey;
 * LightProbeGenerator over its cube, 128 pixels a face), turned half about the vertical: its bright side is behind the viewer,
 * who stands towards -Z here. Every surface here is matt, so that is all of it that shows; drawing and filtering the cube at every
 * start took a machine without a graphics card two seconds.
 */
const SURROUNDINGS = [3.7443, 1.7552, -1.6379, -0.2751, -0.2149, -1.089, 1.2234, -0.3486, -0.6103];

/** What the floor, seen at a flat angle, mirrors of the surroundings: it lifts its shadows a little. */
const GLOSS = 0.085;

export interface Room {
  group: Group;
  key: DirectionalLight;
  setTheme(theme: Theme): void;
  /** Takes the walls away and the fog far off, for crowds that need the floor. */
  setOpen(open: boolean): void;
  /** How far the viewer is from what is looked at, metres: the fog begins behind it. */
  seenFrom(metres: number): void;
  /** Whether the floor is drawn: not where a scene has ground of its own. */
  showFloor(shown: boolean): void;
  /** Shadows of 512 pixels while frames are spared, of 2048 otherwise. */
  setDetail(sparing: boolean): void;
  dispose(): void;
}

/** A wall with its cove at the foot, along +-X at z = 0, facing -Z. */
function wallGeometry(length: number): BufferGeometry {
  const profile: [number, number][] = [];
  const n = 10;
  for (let i = 0; i <= n; i++) {
    const a = (i / n) * (Math.PI / 2);
    profile.push([-COVE + COVE * Math.sin(a), COVE - COVE * Math.cos(a)]);
  }
  profile.push([0, HEIGHT]);
  const positions: number[] = [];
  const index: number[] = [];
  for (const x of [-length / 2, length / 2]) for (const [z, y] of profile) positions.push(x, y, z);
  const m = profile.length;
  for (let i = 0; i + 1 < m; i++) index.push(i, i + 1, m + i, m + i, i + 1, m + i + 1);
  const g = new BufferGeometry();
  g.setAttribute("position", new Float32BufferAttribute(positions, 3));
  g.setIndex(index);
  g.computeVertexNormals();
  return g;
}

/** Builds the room into a scene. */
export function createRoom(scene: Scene): Room {
  const group = new Group();
  const surroundings = new LightProbe(
    new SphericalHarmonics3().fromArray(SURROUNDINGS.flatMap((v) => [v, v, v])),
  );
  const grid = { uGrid: { value: new Color() }, uFine: { value: 0.1 }, uCoarse: { value: 0.19 } };
  const floorMaterial = new MeshStandardMaterial({ roughness: 0.74, metalness: 0 });
  floorMaterial.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, grid);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;")
      .replace(
        "#include <worldpos_vertex>",
        "#include <worldpos_vertex>\nvPlace = (modelMatrix * vec4(transformed, 1.0)).xyz;",
      );
    shader.fragmentShader = shader.fragmentShader
      .replace(
        "#include <common>",
        `#include <common>
varying vec3 vPlace; uniform vec3 uGrid; uniform float uFine; uniform float uCoarse;
float gridLine(vec2 p, float every, float width) {
  vec2 q = p / every; vec2 w = fwidth(q);
  vec2 d = abs(fract(q - 0.5) - 0.5) / max(w, vec2(1e-6));
  float line = 1.0 - min(min(d.x, d.y) / width, 1.0);
  return line * (1.0 - smoothstep(0.25, 0.6, max(w.x, w.y)));
}`,
      )
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
float fade = 1.0 - smoothstep(2.6, 5.2, length(vPlace.xz));
diffuseColor.rgb = mix(diffuseColor.rgb, uGrid, gridLine(vPlace.xz, 0.25, 1.0) * uFine * fade);
diffuseColor.rgb = mix(diffuseColor.rgb, uGrid, gridLine(vPlace.xz, 1.0, 1.3) * uCoarse * fade);`,
      );
  };
  // In squares: of a fan whose triangles all meet under the viewer, one could be left out where the camera stands near its edge.
  const floor = new Mesh(new PlaneGeometry(60, 60, 12, 12).rotateX(-Math.PI / 2), floorMaterial);
  floor.receiveShadow = true;
  group.add(floor);
  const wallMaterial = new MeshStandardMaterial({ roughness: 0.9, side: DoubleSide });
  const sideMaterial = new MeshStandardMaterial({ roughness: 0.9, side: DoubleSide });
  // The viewer stands towards -Z, so that a board faced along +Z is seen from its front.
  const back = new Mesh(wallGeometry(24), wallMaterial);
  back.position.z = BACK;
  back.receiveShadow = true;
  const side = new Mesh(wallGeometry(24), sideMaterial);
  side.rotation.y = Math.PI / 2;
  side.position.x = LEFT;
  side.receiveShadow = true;
  group.add(back, side);
  const hemisphere = new HemisphereLight();
  const key = new DirectionalLight();
  key.position.set(-3.4, 6, -4.6);
  key.castShadow = true;
  key.shadow.mapSize.set(2048, 2048);
  key.shadow.radius = 7;
  key.shadow.blurSamples = 20;
  key.shadow.bias = -0.0004;
  key.shadow.normalBias = 0.02;
  const c = key.shadow.camera;
  c.left = c.bottom = -6.2;
  c.right = c.top = 6.2;
  c.near = 0.5;
  c.far = 22;
  const fill = new DirectionalLight();
  fill.position.set(5, 3.5, -3);
  group.add(surroundings, hemisphere, key, key.target, fill);
  scene.add(group);
  let open = false;
  let distance = 8;
  const fogOf = (colour: string | number): Fog => {
    const near = Math.max(open ? 24 : 12, distance + 4);
    return new Fog(colour, near, near + (open ? 36 : 10));
  };
  return {
    group,
    key,
    setOpen(now) {
      open = now;
      back.visible = side.visible = !open;
      if (scene.fog) scene.fog = fogOf(scene.fog.color.getHex());
    },
    seenFrom(metres) {
      distance = metres;
      const { near, far } = fogOf(0);
      if (scene.fog instanceof Fog) Object.assign(scene.fog, { near, far });
    },
    setTheme(theme) {
      const t = ROOMS[theme];
      wallMaterial.color.set(t.wall);
      sideMaterial.color.set(t.side);
      floorMaterial.color.set(t.floor);
      scene.background = new Color(t.fog);
      scene.fog = fogOf(t.fog);
      surroundings.intensity = t.environment;
      floorMaterial.emissive.setScalar(GLOSS * t.environment);
      hemisphere.color.set(t.hemisphere[0]);
      hemisphere.groundColor.set(t.hemisphere[1]);
      hemisphere.intensity = t.hemisphere[2];
      key.color.set(t.key[0]);
      key.intensity = t.key[1];
      key.shadow.intensity = t.shadow;
      fill.color.set(t.fill[0]);
      fill.intensity = t.fill[1];
      grid.uGrid.value.set(t.grid[0]);
      grid.uFine.value = t.grid[1];
      grid.uCoarse.value = t.grid[2];
    },
    showFloor(shown) {
      floor.visible = shown;
    },
    setDetail(sparing) {
      const { shadow } = key;
      const size = sparing ? 512 : 2048;
      if (shadow.mapSize.x === size) return;
      shadow.mapSize.set(size, size);
      shadow.radius = sparing ? 3 : 7;
      shadow.blurSamples = sparing ? 8 : 20;
      // Made anew at its size by the next frame.
      shadow.map?.dispose();
      shadow.mapPass?.dispose();
      shadow.map = null;
      shadow.mapPass = null;
    },
    dispose() {
      for (const m of [floor, back, side]) m.geometry.dispose();
      for (const m of [floorMaterial, wallMaterial, sideMaterial]) m.dispose();
    },
  };
}
