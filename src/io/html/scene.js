// The picture: faces, lines and dots, and the camera.

const FACES = {
  vertex: `
    precision highp float;
    in vec3 position;
    in vec4 colour;
    in float spot;
    uniform mat4 modelViewMatrix;
    uniform mat4 projectionMatrix;
    out vec3 place;
    out vec3 corner;
    out vec4 paint;
    out float level;
    void main() {
      int at = gl_VertexID % 3;
      corner = vec3(at == 0, at == 1, at == 2);
      paint = colour;
      level = spot;
      vec4 seen = modelViewMatrix * vec4(position, 1.0);
      place = seen.xyz;
      gl_Position = projectionMatrix * seen;
    }`,
  // Edges fade where they are as near to each other as pixels.
  fragment: `
    precision highp float;
    in vec3 place;
    in vec3 corner;
    in vec4 paint;
    in float level;
    uniform vec3 scale[5];
    uniform float light;
    uniform float edges;
    out vec4 pixel;
    void main() {
      vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
      float shade = mix(1.0, 0.45 + 0.55 * abs(normal.z), light);
      float step = clamp(level, 0.0, 1.0) * 4.0;
      int from = min(int(step), 3);
      vec3 between = mix(scale[from], scale[from + 1], step - float(from));
      vec3 own = paint.a > 0.5 ? paint.rgb : between;
      vec3 width = fwidth(corner);
      vec3 near = smoothstep(vec3(0.15), vec3(0.85), corner / max(width, vec3(1e-9)));
      float line = 1.0 - min(near.x, min(near.y, near.z));
      float room = 1.0 - smoothstep(0.08, 0.3, max(width.x, max(width.y, width.z)));
      pixel = vec4(mix(own * shade, vec3(0.1, 0.12, 0.15), 0.7 * edges * line * room), 1.0);
    }`,
};

// Lines and dots are squares of some pixels' width, a little nearer to the eye than faces.
const MARKS = {
  vertex: `
    precision highp float;
    in vec3 position;
    in vec3 start;
    in vec3 end;
    uniform mat4 modelViewMatrix;
    uniform mat4 projectionMatrix;
    uniform vec2 screen;
    uniform float width;
    out vec2 within;
    void main() {
      within = start == end ? position.xy : vec2(0.0);
      vec4 from = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
      vec4 to = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
      vec2 way = (to.xy / to.w - from.xy / from.w) * screen;
      vec2 along = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
      vec2 shift = position.x * along + position.y * vec2(-along.y, along.x);
      gl_Position = position.x < 0.0 ? from : to;
      gl_Position.xy += shift * width / screen * gl_Position.w;
      gl_Position.z -= 4e-4 * gl_Position.w;
    }`,
  fragment: `
    precision highp float;
    in vec2 within;
    uniform vec3 paint;
    out vec4 pixel;
    void main() {
      if (dot(within, within) > 1.0) discard;
      pixel = vec4(paint, 1.0);
    }`,
};

function material(source, uniforms) {
  return new THREE.RawShaderMaterial({
    glslVersion: THREE.GLSL3,
    vertexShader: source.vertex,
    fragmentShader: source.fragment,
    uniforms,
    side: THREE.DoubleSide,
  });
}

class Picture {
  constructor(canvas, mesh) {
    this.canvas = canvas;
    this.mesh = mesh;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setClearColor(0xffffff, 1);
    this.scene = new THREE.Scene();
    const isPlane = mesh.dim === 2;
    this.camera = isPlane ? new THREE.OrthographicCamera() : new THREE.PerspectiveCamera(35);
    this.camera.up.set(0, isPlane ? 1 : 0, isPlane ? 0 : 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    // Buttons and fingers: 0 turns, 2 moves.
    if (isPlane) {
      Object.assign(this.controls, { enableRotate: false, mouseButtons: { LEFT: 2, MIDDLE: 1, RIGHT: 2 } });
      this.controls.touches = { ONE: 1, TWO: 2 };
    }
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    const screen = { value: { x: 1, y: 1, isVector2: true } };
    this.screen = screen.value;
    const scale = { value: SCALE.map((colour) => new THREE.Vector3(...colour.map((x) => x / 255))) };
    this.faces = this.add(material(FACES, { light: { value: isPlane ? 0 : 1 }, edges: { value: 1 }, scale }));
    const mark = (paint, width) => this.add(material(MARKS, { paint: { value: paint }, width: { value: width }, screen }));
    this.lines = mark(new THREE.Vector3(0, 0, 0), 1.6);
    this.dots = mark(new THREE.Vector3(0.64, 0.15, 0.17), isPlane ? 6 : 5);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
  }

  add(material) {
    const object = new THREE.Mesh(new THREE.BufferGeometry(), material);
    object.frustumCulled = false;
    object.visible = false;
    this.scene.add(object);
    return object;
  }

  replace(object, geometry) {
    object.geometry.dispose();
    object.geometry = geometry;
    object.visible = true;
  }

  /** Shows faces in the colours of a colouring. */
  showFaces(faces, colouring) {
    const { points } = this.mesh;
    const places = new Float32Array(9 * faces.count);
    const colours = new Uint8Array(12 * faces.count);
    // The picture goes through the scale between vertices; a cell with a vertex without a value is grey.
    const spots = new Float32Array(colouring.of === "vertices" ? 3 * faces.count : 0);
    for (let face = 0; face < faces.count; face++) {
      const vertices = faces.vertices.subarray(3 * face, 3 * face + 3);
      let colour = MISSING;
      let isSmooth = false;
      if (spots.length === 0) {
        colour = colourOf(colouring, (colouring.of === "facets" ? faces.facets : faces.cells)[face]);
      } else {
        vertices.forEach((vertex, at) => (spots[3 * face + at] = colouring.place(colouring.values[vertex])));
        const own = spots.subarray(3 * face, 3 * face + 3);
        isSmooth = !own.some(Number.isNaN);
        own.forEach((spot, at) => (own[at] = Math.min(Math.max(spot, -9), 9) || 0));
      }
      for (let at = 0; at < 3; at++) {
        const corner = 3 * face + at;
        for (let axis = 0; axis < 3; axis++) {
          places[3 * corner + axis] = points[3 * vertices[at] + axis];
          colours[4 * corner + axis] = colour[axis] + 0.5;
        }
        colours[4 * corner + 3] = isSmooth ? 0 : 255;
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
    geometry.setAttribute("colour", new THREE.BufferAttribute(colours, 4, true));
    if (spots.length > 0) geometry.setAttribute("spot", new THREE.BufferAttribute(spots, 1));
    this.replace(this.faces, geometry);
  }

  /** Shows lines between two vertices each, or dots where these are one, in `lines` or `dots`. */
  showMarks(object, ends) {
    const { points } = this.mesh;
    const at = (vertex) => points.subarray(3 * vertex, 3 * vertex + 3);
    const [starts, stops] = [0, 1].map((end) => {
      const places = new Float32Array((3 * ends.length) / 2);
      for (let mark = 0; 2 * mark < ends.length; mark++) places.set(at(ends[2 * mark + end]), 3 * mark);
      return new THREE.InstancedBufferAttribute(places, 3);
    });
    const geometry = new THREE.InstancedBufferGeometry();
    const corners = new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]);
    geometry.setAttribute("position", new THREE.BufferAttribute(corners, 3));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    geometry.setAttribute("start", starts);
    geometry.setAttribute("end", stops);
    geometry.instanceCount = ends.length / 2;
    this.replace(object, geometry);
    object.visible = ends.length > 0;
  }

  /** Looks at a box from the given direction, in degrees round z and above the plane, so that all of it is seen. */
  look(box, [round, above], zoom) {
    const center = box.map(([least, most]) => (least + most) / 2);
    this.box = box;
    this.controls.target.set(...center);
    const isPlane = this.mesh.dim === 2;
    const [turn, tilt] = [round, above].map((degrees) => (degrees * Math.PI) / 180);
    const way = isPlane ? [0, 0, 1] : [Math.cos(tilt) * Math.cos(turn), Math.cos(tilt) * Math.sin(turn), Math.sin(tilt)];
    const distance = isPlane ? 3 : distanceOf(box, way, this.camera.fov, this.canvas.parentElement) / zoom;
    this.camera.position.set(...center.map((x, axis) => x + distance * way[axis]));
    this.camera.zoom = isPlane ? zoom : 1;
    this.resize();
    this.controls.update();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0 || !this.box) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height);
    [this.screen.x, this.screen.y] = [width, height];
    const { camera } = this;
    if (camera.isPerspectiveCamera) {
      camera.aspect = width / height;
    } else {
      const [x, y] = this.box.map(([least, most]) => ((most - least) / 2) * 1.05 || 1e-9);
      const half = Math.max(y, (x * height) / width);
      [camera.left, camera.right] = [(-half * width) / height, (half * width) / height];
      [camera.bottom, camera.top] = [-half, half];
    }
    this.draw();
  }

  draw() {
    const { camera } = this;
    const far = camera.position.distanceTo(this.controls.target) + 8;
    [camera.near, camera.far] = [camera.isPerspectiveCamera ? Math.max(1e-6, (far - 8) * 0.02) : 0.001, far];
    camera.updateProjectionMatrix();
    this.renderer.render(this.scene, camera);
  }

  /** Returns the number of the face under a place of the canvas, or -1. */
  faceAt(faces, x, y) {
    const { points } = this.mesh;
    const { clientWidth, clientHeight } = this.canvas;
    const [right, up] = [(2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight];
    const from = new THREE.Vector3(right, up, -1).unproject(this.camera);
    const way = new THREE.Vector3(right, up, 1).unproject(this.camera).sub(from);
    const [a, b, c, normal, across] = Array.from({ length: 5 }, () => new THREE.Vector3());
    let [found, nearest] = [-1, Infinity];
    for (let face = 0; face < faces.count; face++) {
      [a, b, c].forEach((corner, at) => corner.fromArray(points, 3 * faces.vertices[3 * face + at]));
      b.sub(a);
      c.sub(a);
      a.subVectors(from, a);
      const turned = -way.dot(normal.crossVectors(b, c));
      if (turned === 0) continue;
      const depth = a.dot(normal) / turned;
      across.crossVectors(a, way);
      const [u, v] = [c.dot(across) / turned, -b.dot(across) / turned];
      if (depth < 0 || depth >= nearest || !isInside(u, v)) continue;
      [found, nearest] = [face, depth];
    }
    return found;
  }
}

/** Returns the least distance from the centre of a box at which all of it is seen, by one that looks against `way`. */
function distanceOf(box, way, fieldOfView, { clientWidth, clientHeight }) {
  const tangent = Math.tan((fieldOfView * Math.PI) / 360) * 0.94;
  const aspect = clientWidth / Math.max(clientHeight, 1) || 1;
  const forth = new THREE.Vector3(...way);
  const right = new THREE.Vector3(0, 0, 1).cross(forth);
  // Seen along z there is no right; any will do.
  if (right.length() < 1e-6) right.set(1, 0, 0);
  right.normalize();
  const up = new THREE.Vector3().crossVectors(forth, right);
  let least = 1e-6;
  for (let index = 0; index < 8; index++) {
    const corner = new THREE.Vector3(...box.map(([from, to], axis) => ((index >> axis) & 1 ? 0.5 : -0.5) * (to - from)));
    const room = Math.max(Math.abs(corner.dot(right)) / aspect, Math.abs(corner.dot(up)));
    least = Math.max(least, corner.dot(forth) + room / tangent);
  }
  return least;
}

function isInside(u, v) {
  return u >= 0 && v >= 0 && u + v <= 1;
}
