"use strict";
// A folded structure to turn by mouse, touch and keys: paper with shaded folds, creases as lines, colour maps.
(function () {
  const figure = document.getElementById("viewer");
  const canvas = figure.querySelector("canvas");
  const scene = JSON.parse(document.getElementById("scene").textContent);
  const gl = canvas.getContext("webgl", { antialias: true, alpha: true, preserveDrawingBuffer: true });
  if (!gl || !gl.getExtension("OES_element_index_uint")) {
    return; // the picture below stays
  }

  function bytes(text) {
    const raw = atob(text);
    const out = new Uint8Array(raw.length);
    for (let k = 0; k < raw.length; k++) out[k] = raw.charCodeAt(k);
    return out.buffer;
  }

  const PAPER = `
    attribute vec3 place, normal, tint;
    attribute vec2 open;
    uniform mat4 view;
    uniform mat3 turn;
    varying vec3 n, colour;
    varying vec2 sky;
    void main() {
      n = turn * normal;
      colour = tint;
      sky = open;
      gl_Position = view * vec4(place, 1.0);
    }`;
  const LIGHT = `
    precision mediump float;
    varying vec3 n, colour;
    varying vec2 sky;
    uniform float painted;
    void main() {
      bool front = gl_FrontFacing;
      vec3 m = normalize(front ? n : -n);
      float open = front ? sky.x : sky.y;
      float facing = dot(m, vec3(-0.519, 0.585, 0.623));
      float direct = max(facing, 0.0) * smoothstep(0.05, 0.6, open) + 0.16 * max(-facing, 0.0);
      float dome = open * (0.9 + 0.1 * m.y);
      vec3 bounced = dome / (1.0 - vec3(0.76, 0.70, 0.61) * (1.0 - dome));
      vec3 light = vec3(0.56, 0.535, 0.48) * direct + vec3(0.50, 0.485, 0.465) * bounced;
      vec3 tone = sqrt(light / (1.0 + 0.06 * light));
      vec3 paper = (front ? vec3(0.992, 0.965, 0.906) : vec3(0.953, 0.875, 0.769)) * tone;
      gl_FragColor = vec4(mix(paper, colour * (0.45 + 0.55 * tone), painted), 1.0);
    }`;
  const STROKE = `
    attribute vec3 here, there;
    attribute float side;
    uniform mat4 view;
    uniform vec2 size;
    uniform float width;
    void main() {
      vec4 p = view * vec4(here, 1.0), q = view * vec4(there, 1.0);
      vec2 along = (q.xy / q.w - p.xy / p.w) * size;
      vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-6);
      gl_Position = p;
      gl_Position.xy += side * width * across / size * p.w;
      gl_Position.z -= 0.0012 * p.w;
    }`;
  const INK = `
    precision mediump float;
    uniform vec4 ink;
    void main() { gl_FragColor = ink; }`;

  function program(vertex, fragment) {
    const made = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    return made;
  }

  function buffer(data, target) {
    const made = gl.createBuffer();
    gl.bindBuffer(target || gl.ARRAY_BUFFER, made);
    gl.bufferData(target || gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    return made;
  }

  function attribute(made, name, data, size, type, normalised) {
    const place = gl.getAttribLocation(made, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, data);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type || gl.FLOAT, Boolean(normalised), 0, 0);
  }

  // geometry: vertices shared by faces and lines, corners with normals and openness of their own
  const vertices = new Float32Array(bytes(scene.vertices));
  const corner = new Uint32Array(bytes(scene.corners));
  const triangles = new Uint32Array(bytes(scene.triangles));
  const places = new Float32Array(3 * corner.length);
  corner.forEach((v, k) => places.set(vertices.subarray(3 * v, 3 * v + 3), 3 * k));
  let paper, stroke, data, maps, lines;

  function upload() { // what a lost context takes with it
    gl.getExtension("OES_element_index_uint");
    paper = program(PAPER, LIGHT);
    stroke = program(STROKE, INK);
    data = {
      place: buffer(places), normal: buffer(new Int16Array(bytes(scene.normals))), open: buffer(new Uint8Array(bytes(scene.open))),
      index: buffer(triangles, gl.ELEMENT_ARRAY_BUFFER), plain: buffer(new Uint8Array(4 * corner.length)),
    };
    maps = {};
    for (const map of scene.maps) maps[map.name] = buffer(new Uint8Array(bytes(map.colours)));
    lines = scene.lines.map(uploaded);
    figure.classList.add("live");
  }

  function uploaded(line) {
    const pairs = new Uint32Array(bytes(line.edges));
    const count = pairs.length / 2, here = new Float32Array(18 * count), there = new Float32Array(18 * count);
    const side = new Float32Array(6 * count);
    for (let e = 0; e < count; e++) {
      const a = vertices.subarray(3 * pairs[2 * e], 3 * pairs[2 * e] + 3);
      const b = vertices.subarray(3 * pairs[2 * e + 1], 3 * pairs[2 * e + 1] + 3);
      [[a, b, 1], [a, b, -1], [b, a, 1], [b, a, 1], [b, a, -1], [a, b, 1]].forEach(function ([p, q, s], k) {
        here.set(p, 18 * e + 3 * k);
        there.set(q, 18 * e + 3 * k);
        side[6 * e + k] = s;
      });
    }
    return { ...line, count: 6 * count, here: buffer(here), there: buffer(there), side: buffer(side) };
  }

  const start = { azimuth: 0, elevation: scene.elevation, zoom: 1 };
  const state = { ...start, map: "paper", creases: true, rulings: false, turning: false };
  const basis = scene.basis; // rows: towards the viewer on the ground, to the right, upright

  function rows() {
    const [a, b, c] = basis, ca = Math.cos(state.azimuth), sa = Math.sin(state.azimuth);
    const ce = Math.cos(state.elevation), se = Math.sin(state.elevation);
    const level = [0, 1, 2].map((k) => ca * a[k] + sa * b[k]);
    const right = [0, 1, 2].map((k) => -sa * a[k] + ca * b[k]);
    const towards = [0, 1, 2].map((k) => ce * level[k] + se * c[k]);
    const up = [0, 1, 2].map((k) => ce * c[k] - se * level[k]);
    return [right, up, towards];
  }

  function matrices() {
    const [right, up, towards] = rows(), aspect = canvas.width / canvas.height;
    const reach = Math.max(1, 1 / aspect) / state.zoom, far = 6; // the structure fits a unit sphere
    const near = far - 2, depth = far + 2, f = far / 1.08 / reach;
    const view = new Float32Array(16);
    for (let k = 0; k < 3; k++) {
      view[4 * k] = f / aspect * right[k];
      view[4 * k + 1] = f * up[k];
      view[4 * k + 2] = -towards[k] * (depth + near) / (depth - near);
      view[4 * k + 3] = -towards[k];
    }
    view[14] = (depth + near) / (depth - near) * far - 2 * depth * near / (depth - near);
    view[15] = far;
    const turn = new Float32Array([0, 1, 2].flatMap((k) => [right[k], up[k], towards[k]]));
    return { view, turn };
  }

  function draw() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * ratio), height = Math.round(canvas.clientHeight * ratio);
    if (!width || !height || gl.isContextLost()) return;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const { view, turn } = matrices();
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.useProgram(paper);
    gl.uniformMatrix4fv(gl.getUniformLocation(paper, "view"), false, view);
    gl.uniformMatrix3fv(gl.getUniformLocation(paper, "turn"), false, turn);
    gl.uniform1f(gl.getUniformLocation(paper, "painted"), state.map === "paper" ? 0 : 1);
    attribute(paper, "place", data.place, 3);
    attribute(paper, "normal", data.normal, 4, gl.SHORT, true);
    attribute(paper, "open", data.open, 2, gl.UNSIGNED_BYTE, true);
    attribute(paper, "tint", maps[state.map] || data.plain, 4, gl.UNSIGNED_BYTE, true);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, data.index);
    gl.drawElements(gl.TRIANGLES, triangles.length, gl.UNSIGNED_INT, 0);
    gl.useProgram(stroke);
    gl.uniformMatrix4fv(gl.getUniformLocation(stroke, "view"), false, view);
    gl.uniform2f(gl.getUniformLocation(stroke, "size"), width, height);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    for (const line of lines) {
      if (line.kind === "ruling" ? !state.rulings : line.kind !== "boundary" && !state.creases) continue;
      gl.uniform1f(gl.getUniformLocation(stroke, "width"), ratio * line.width * Math.sqrt(state.zoom));
      gl.uniform4fv(gl.getUniformLocation(stroke, "ink"), line.ink);
      attribute(stroke, "here", line.here, 3);
      attribute(stroke, "there", line.there, 3);
      attribute(stroke, "side", line.side, 1);
      gl.drawArrays(gl.TRIANGLES, 0, line.count);
    }
    gl.disable(gl.BLEND);
  }

  let waiting = false;
  function redraw() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(function () {
      waiting = false;
      if (state.turning) state.azimuth += 0.006;
      draw();
      if (state.turning) redraw();
    });
  }

  function orbit(right, up) {
    state.azimuth -= right;
    state.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, state.elevation + up));
    redraw();
  }

  function zoom(factor) {
    state.zoom = Math.max(0.4, Math.min(12, state.zoom * factor));
    redraw();
  }

  const fingers = new Map();
  canvas.addEventListener("pointerdown", function (event) {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    setTurning(false);
  });
  canvas.addEventListener("pointermove", function (event) {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const other = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at)[0];
    const now = [event.clientX, event.clientY];
    if (other) {
      const apart = (at) => Math.hypot(at[0] - other[0], at[1] - other[1]) || 1;
      zoom(apart(now) / apart(before));
    } else {
      orbit((now[0] - before[0]) * 0.008, (now[1] - before[1]) * 0.008);
    }
    fingers.set(event.pointerId, now);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(name, (event) => fingers.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", function (event) {
    if (document.activeElement !== canvas && !event.ctrlKey) return; // the page scrolls until the view is taken up
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * 0.0015));
  }, { passive: false });
  canvas.addEventListener("keydown", function (event) {
    const keys = {
      ArrowLeft: () => orbit(-0.1, 0), ArrowRight: () => orbit(0.1, 0), ArrowUp: () => orbit(0, 0.1),
      ArrowDown: () => orbit(0, -0.1), "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15),
      "0": reset, Home: reset, " ": () => setTurning(!state.turning),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  });

  function reset() {
    Object.assign(state, start);
    redraw();
  }

  function setTurning(on) {
    state.turning = on;
    figure.querySelector("[name=turning]").checked = on;
    redraw();
  }

  for (const box of figure.querySelectorAll("input[type=checkbox]")) {
    box.addEventListener("change", function () {
      state[box.name] = box.checked;
      redraw();
    });
  }
  for (const choice of figure.querySelectorAll("input[type=radio]")) {
    choice.addEventListener("change", function () {
      state.map = choice.value;
      for (const scale of figure.querySelectorAll(".scale")) scale.hidden = scale.dataset.map !== state.map;
      redraw();
    });
  }
  figure.querySelector("button").addEventListener("click", reset);
  canvas.addEventListener("webglcontextlost", function (event) {
    event.preventDefault(); // asks for a new context
    figure.classList.remove("live"); // until then the picture shows
  });
  canvas.addEventListener("webglcontextrestored", function () {
    upload();
    redraw();
  });
  new ResizeObserver(redraw).observe(canvas);
  if (!gl.isContextLost()) upload();
  redraw();
})();

(function () {
  const button = document.getElementById("copy");
  if (!button) return;
  button.addEventListener("click", function () {
    const recipe = document.getElementById("recipe");
    const done = () => { button.textContent = "copied"; };
    const select = () => getSelection().selectAllChildren(recipe);
    if (navigator.clipboard) navigator.clipboard.writeText(recipe.textContent).then(done, select);
    else select();
  });
})();
