// Draws one mesh at many places with WebGL 2, coloured by a value at each point.

// Light is found at the vertices, and colours are not mixed: quicker where processors draw pixels.
// Both sides of the fabric are lit alike, from the upper left behind the eye.
const VERTEX_PROGRAM = `#version 300 es
in vec3 position; in vec3 normal; in float value; in vec2 place;
uniform mat4 view; uniform mat3 turn; uniform float pitch; uniform vec2 range;
out vec2 light; out float share;
void main() {
  gl_Position = view * vec4(position + vec3(place * pitch, 0.0), 1.0);
  float facing = abs(dot(turn * normalize(normal), vec3(-0.30, 0.40, 0.87)));
  light = vec2(0.42 + 0.58 * facing, 0.10 * pow(facing, 20.0));
  share = clamp((value - range.x) / (range.y - range.x), 0.002, 0.998);
}`;

const FRAGMENT_PROGRAM = `#version 300 es
precision mediump float;
in vec2 light; in float share;
uniform sampler2D scale;
out vec4 colour;
void main() { colour = vec4(texture(scale, vec2(share, 0.5)).rgb * light.x + light.y, 1.0); }`;

// Whether triangles are drawn by the processor: smooth edges then cost three times as much.
function drawsSlowly() {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return true;
  const more = gl.getExtension('WEBGL_debug_renderer_info');
  const name = gl.getParameter(more ? more.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

class Painter {
  constructor(canvas, antialias) {
    const gl = canvas.getContext('webgl2', { antialias });
    if (!gl) throw new Error('this browser draws no WebGL 2');
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX_PROGRAM], [gl.FRAGMENT_SHADER, FRAGMENT_PROGRAM]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) {
      throw new Error(gl.getProgramInfoLog(this.program) || 'the shaders do not link');
    }
    gl.useProgram(this.program);
    gl.enable(gl.DEPTH_TEST);
    this.uniforms = Object.fromEntries(
      ['view', 'turn', 'pitch', 'range'].map((name) => [name, gl.getUniformLocation(this.program, name)]),
    );
    this.places = gl.createBuffer();
    this.meshes = {};
  }

  // Colours from low to high, as [r, g, b] from 0 to 255.
  colours(name, stops) {
    const gl = this.gl, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    const pixels = Uint8Array.from(stops.flat());
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, stops.length, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, pixels);
    for (const key of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, key, gl.NEAREST);
    for (const key of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, key, gl.CLAMP_TO_EDGE);
    this.mesh(name).texture = texture;
  }

  mesh(name) {
    const gl = this.gl;
    if (!this.meshes[name]) {
      const mesh = { array: gl.createVertexArray(), buffers: {}, count: 0, range: [0, 1] };
      gl.bindVertexArray(mesh.array);
      for (const [key, width] of [['points', 3], ['normals', 3], ['values', 1]]) {
        mesh.buffers[key] = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[key]);
        this.attribute({ points: 'position', normals: 'normal', values: 'value' }[key], width);
      }
      gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
      gl.vertexAttribDivisor(this.attribute('place', 2), 1);
      mesh.triangles = gl.createBuffer();
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, mesh.triangles);
      this.meshes[name] = mesh;
    }
    return this.meshes[name];
  }

  attribute(name, width) {
    const place = this.gl.getAttribLocation(this.program, name);
    this.gl.enableVertexAttribArray(place);
    this.gl.vertexAttribPointer(place, width, this.gl.FLOAT, false, 0, 0);
    return place;
  }

  fill(name, surface, range) {
    const gl = this.gl, mesh = this.mesh(name);
    gl.bindVertexArray(mesh.array);
    for (const key of ['points', 'normals', 'values']) {
      gl.bindBuffer(gl.ARRAY_BUFFER, mesh.buffers[key]);
      gl.bufferData(gl.ARRAY_BUFFER, surface[key], gl.DYNAMIC_DRAW);
    }
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, surface.triangles, gl.DYNAMIC_DRAW);
    mesh.count = surface.triangles.length;
    mesh.range = range;
  }

  put(places) {
    this.copies = places.length;
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, this.places);
    this.gl.bufferData(this.gl.ARRAY_BUFFER, Float32Array.from(places.flat()), this.gl.STATIC_DRAW);
  }

  draw(view, turn, pitch) {
    const gl = this.gl;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.uniformMatrix4fv(this.uniforms.view, false, view);
    gl.uniformMatrix3fv(this.uniforms.turn, false, turn);
    gl.uniform1f(this.uniforms.pitch, pitch);
    for (const mesh of Object.values(this.meshes)) {
      gl.uniform2fv(this.uniforms.range, mesh.range);
      gl.bindTexture(gl.TEXTURE_2D, mesh.texture);
      gl.bindVertexArray(mesh.array);
      gl.drawElementsInstanced(gl.TRIANGLES, mesh.count, gl.UNSIGNED_INT, 0, this.copies);
    }
  }
}
