// A small viewer of one glTF file with one animation: drag turns, the wheel or a pinch zooms, shift-drag moves.
(() => {
  "use strict";
  const box = document.querySelector("#replay .stage"), data = document.querySelector("#replay-scene");
  if (!box || !data) return;
  const canvas = box.querySelector("canvas"), button = box.querySelector("button"), bar = box.querySelector("input");
  const clock = box.querySelector("output"), gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) { box.classList.add("without"); return; }

  // the file
  const bytes = Uint8Array.from(atob(data.textContent.trim()), (c) => c.charCodeAt(0)).buffer;
  const head = new DataView(bytes), long = head.getUint32(12, true);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, long)));
  const read = (index) => {
    const a = told.accessors[index], view = told.bufferViews[a.bufferView], size = { SCALAR: 1, VEC3: 3, VEC4: 4 }[a.type];
    return new (a.componentType === 5125 ? Uint32Array : Float32Array)(bytes, 28 + long + view.byteOffset, a.count * size);
  };

  // matrices, column by column
  const times = (a, b) => {
    const out = new Float32Array(16);
    for (let c = 0; c < 4; c++) for (let r = 0; r < 4; r++) for (let k = 0; k < 4; k++) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    return out;
  };
  const posed = (p, [x, y, z, w]) => new Float32Array([
    1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w), 0, 2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w), 0,
    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y), 0, p[0], p[1], p[2], 1]);
  const sub = (a, b) => a.map((v, k) => v - b[k]), dot = (a, b) => a.reduce((s, v, k) => s + v * b[k], 0);
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => a.map((v) => v / Math.hypot(...a));
  const looking = (eye, at, up) => {
    const z = unit(sub(eye, at)), x = unit(cross(up, z)), y = cross(z, x);
    return new Float32Array([x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1]);
  };
  const lens = (angle, aspect, near, far) => {
    const f = 1 / Math.tan(angle / 2);
    return new Float32Array([f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0]);
  };
  const flat = (half, near, far) =>
    new Float32Array([1 / half, 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1]);

  // programs
  const built = (vertex, fragment) => {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, "#version 300 es\nprecision highp float;\n" + text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.bindAttribLocation(program, 0, "place");
    gl.bindAttribLocation(program, 1, "normal");
    gl.linkProgram(program);
    const where = {};
    return { use: () => gl.useProgram(program), at: (name) => where[name] ??= gl.getUniformLocation(program, name) };
  };
  const shade = built(
    `in vec3 place; in vec3 normal; uniform mat4 model, eye_clip, light_clip; out vec3 world, way; out vec4 lit;
     void main() { vec4 p = model * vec4(place, 1.0); world = p.xyz; way = mat3(model) * normal; lit = light_clip * p; gl_Position = eye_clip * p; }`,
    `in vec3 world, way; in vec4 lit; uniform vec4 colour; uniform vec2 finish; uniform vec3 eye, light; uniform highp sampler2DShadow shadow; out vec4 seen;
     void main() {
       vec3 n = normalize(way), v = normalize(eye - world), h = normalize(light + v);
       if (dot(n, v) < 0.0) n = -n;
       vec3 q = lit.xyz * 0.5 + 0.5; float open = 0.0;
       for (int x = -1; x < 2; x++) for (int y = -1; y < 2; y++) open += texture(shadow, vec3(q.xy + vec2(x, y) / 1536.0, q.z - 0.0012)) / 9.0;
       if (any(greaterThan(abs(q - 0.5), vec3(0.5)))) open = 1.0;
       float rough = max(finish.x, 0.08), a = rough * rough, d = max(dot(n, h), 0.0) * max(dot(n, h), 0.0) * (a * a - 1.0) + 1.0;
       vec3 base = colour.rgb * (1.0 - finish.y), gloss = mix(vec3(0.04), colour.rgb, finish.y);
       float facing = max(dot(n, light), 0.0) * open, rim = pow(1.0 - max(dot(n, v), 0.0), 5.0);
       vec3 sky = mix(vec3(0.30, 0.28, 0.26), vec3(0.62, 0.68, 0.76), 0.5 + 0.5 * n.y);
       vec3 c = base * (sky + vec3(2.1, 2.0, 1.85) * facing) + gloss * (min(a * a / (12.0 * d * d * max(a, 0.02)), 6.0) * facing * 2.0 + sky * (1.0 - 0.6 * rough)) + rim * sky * 0.25 * (1.0 - rough);
       c *= 0.72; c = c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14);
       seen = vec4(pow(c, vec3(1.0 / 2.2)) * colour.a, colour.a);
     }`);
  const cast = built("in vec3 place; uniform mat4 model, light_clip; void main() { gl_Position = light_clip * model * vec4(place, 1.0); }", "out vec4 none; void main() { none = vec4(1.0); }");

  // meshes
  const upload = (kind, array) => { gl.bindBuffer(kind, gl.createBuffer()); gl.bufferData(kind, array, gl.STATIC_DRAW); };
  const low = [1e9, 1e9, 1e9], high = [-1e9, -1e9, -1e9];
  const bodies = told.nodes.slice(1).map((node, number) => ({
    number: number + 1, place: node.translation, turn: node.rotation,
    parts: told.meshes[node.mesh].primitives.map((primitive) => {
      const array = gl.createVertexArray(), material = told.materials[primitive.material].pbrMetallicRoughness;
      gl.bindVertexArray(array);
      ["POSITION", "NORMAL"].forEach((name, slot) => {
        upload(gl.ARRAY_BUFFER, read(primitive.attributes[name]));
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
      });
      const index = read(primitive.indices), span = told.accessors[primitive.attributes.POSITION];
      upload(gl.ELEMENT_ARRAY_BUFFER, index);
      const wide = Math.max(...sub(span.max, span.min));
      return { array, count: index.length, wide, span, colour: material.baseColorFactor, finish: [material.roughnessFactor, material.metallicFactor] };
    }),
  }));
  const tracks = (told.animations?.[0]?.channels || []).map((channel) => {
    const sampler = told.animations[0].samplers[channel.sampler];
    return { body: bodies[channel.target.node - 1], path: channel.target.path, at: read(sampler.input), to: read(sampler.output) };
  });
  const end = tracks.length ? tracks[0].at[tracks[0].at.length - 1] : 0;
  const root = posed([0, 0, 0], told.nodes[0].rotation);
  const pose = (time) => {
    for (const { body, path, at, to } of tracks) {
      let k = at.findIndex((t) => t > time);
      k = k < 0 ? at.length - 1 : Math.max(k, 1);
      const size = path === "rotation" ? 4 : 3, share = at.length > 1 ? Math.min(1, (time - at[k - 1]) / (at[k] - at[k - 1])) : 0;
      const value = Array.from({ length: size }, (_, c) => (1 - share) * to[size * Math.max(k - 1, 0) + c] + share * to[size * k + c]);
      body[path === "rotation" ? "turn" : "place"] = size === 4 ? unit(value) : value;
    }
    for (const body of bodies) body.model = times(root, posed(body.place, body.turn));
  };
  for (const share of [0, 0.25, 0.5, 0.75, 1]) { // what the picture holds: things and their ways, without endless ground
    pose(share * end);
    for (const body of bodies) for (const part of body.parts) {
      if (part.wide > 30) continue;
      const middle = part.span.max.map((v, c) => (v + part.span.min[c]) / 2), m = body.model;
      for (let c = 0; c < 3; c++) {
        const at = m[c] * middle[0] + m[4 + c] * middle[1] + m[8 + c] * middle[2] + m[12 + c];
        low[c] = Math.min(low[c], at - part.wide / 2);
        high[c] = Math.max(high[c], at + part.wide / 2);
      }
    }
  }
  const centre = low[0] < high[0] ? low.map((v, c) => (v + high[c]) / 2) : [0, 0, 0];
  const radius = low[0] < high[0] ? Math.max(Math.hypot(...sub(high, low)) / 2, 0.05) : 1;

  // shadows
  const depth = gl.createTexture(), frame = gl.createFramebuffer(), light = unit([-0.45, 0.8, 0.4]);
  gl.bindTexture(gl.TEXTURE_2D, depth);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, 1536, 1536);
  for (const [name, value] of [[gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE], [gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR]]) gl.texParameteri(gl.TEXTURE_2D, name, value);
  gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  const far = centre.map((v, c) => v + 3 * radius * light[c]);
  const lightClip = times(flat(1.25 * radius, radius, 5 * radius), looking(far, centre, [0, 1, 0.01]));

  // the eye
  let turn = 0.6, rise = 0.4, away = 2.6 * radius, aim = [...centre], now = 0, playing = true, before = 0, changed = true;
  const draw = (program, clear) => {
    for (const body of bodies) {
      gl.uniformMatrix4fv(program.at("model"), false, body.model);
      for (const part of body.parts) {
        if ((part.colour[3] < 1) !== clear || (program === cast && part.wide > 30)) continue;
        gl.bindVertexArray(part.array);
        if (program === shade) { gl.uniform4fv(program.at("colour"), part.colour); gl.uniform2fv(program.at("finish"), part.finish); }
        gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
      }
    }
  };
  const show = () => {
    const scale = Math.min(devicePixelRatio, 2);
    canvas.width = Math.round(canvas.clientWidth * scale);
    canvas.height = Math.round(canvas.clientHeight * scale);
    pose(now);
    gl.enable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.viewport(0, 0, 1536, 1536);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    cast.use();
    gl.uniformMatrix4fv(cast.at("light_clip"), false, lightClip);
    draw(cast, false);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.78, 0.81, 0.85, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const eye = aim.map((v, c) => v + away * [Math.cos(rise) * Math.sin(turn), Math.sin(rise), Math.cos(rise) * Math.cos(turn)][c]);
    shade.use();
    gl.uniformMatrix4fv(shade.at("eye_clip"), false, times(lens(0.7, canvas.width / canvas.height, 0.01 * away, 60 * away + 60), looking(eye, aim, [0, 1, 0])));
    gl.uniformMatrix4fv(shade.at("light_clip"), false, lightClip);
    gl.uniform3fv(shade.at("eye"), eye);
    gl.uniform3fv(shade.at("light"), light);
    draw(shade, false);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    draw(shade, true);
    bar.value = end ? now / end : 0;
    clock.textContent = `${now.toFixed(2)} s`;
  };
  const tick = (at) => {
    if (playing && end) { now = (now + Math.min((at - before) / 1000, 0.1)) % end; changed = true; }
    before = at;
    if (changed && box.getBoundingClientRect().bottom > 0) { show(); changed = false; }
    requestAnimationFrame(tick);
  };
  const play = (on) => { playing = on; button.textContent = on ? "Pause" : "Play"; };
  button.addEventListener("click", () => play(!playing));
  bar.addEventListener("input", () => { play(false); now = bar.value * end; changed = true; });
  const fingers = new Map();
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, [e.clientX, e.clientY]); });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, (e) => fingers.delete(e.pointerId));
  canvas.addEventListener("pointermove", (e) => {
    const last = fingers.get(e.pointerId);
    if (!last) return;
    const [dx, dy] = [e.clientX - last[0], e.clientY - last[1]], other = [...fingers].find(([id]) => id !== e.pointerId)?.[1];
    if (other) away *= Math.hypot(last[0] - other[0], last[1] - other[1]) / Math.max(Math.hypot(e.clientX - other[0], e.clientY - other[1]), 1);
    else if (e.shiftKey) {
      const step = away / canvas.clientHeight * 0.73;
      aim = [aim[0] - step * dx * Math.cos(turn), aim[1] + step * dy, aim[2] + step * dx * Math.sin(turn)];
    } else { turn -= dx * 0.008; rise = Math.max(-0.2, Math.min(1.55, rise + dy * 0.008)); }
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    changed = true;
  });
  canvas.addEventListener("wheel", (e) => { e.preventDefault(); away *= Math.exp(e.deltaY * 0.001); changed = true; }, { passive: false });
  addEventListener("resize", () => { changed = true; });
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) play(false);
  requestAnimationFrame(tick);
})();
