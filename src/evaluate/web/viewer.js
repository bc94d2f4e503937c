"use strict";
// A viewer of high dynamic range images that are to be compared: toggle, zoom, exposure, error, FLIP.
// Each <div class="viewer"> holds a <script type="application/json"> with
//   {width, height, reference, images: [{name, note, half, flip, mean_flip}]},
// or {width, height, images} where no image is a reference,
// where half is base64 of three little-endian binary16 numbers per pixel, rows from the top, and
// flip, if it is there, base64 of one byte per pixel: FLIP against the reference from 0 to 255.
(() => {
  const stops = [[0, 0, 0], [40, 16, 84], [100, 26, 128], [160, 44, 116], [212, 68, 84],
                 [242, 110, 60], [252, 164, 64], [252, 214, 118], [255, 250, 210]];

  const halves = new Float32Array(65536);
  for (let i = 0; i < 65536; ++i) {
    const sign = i & 0x8000 ? -1 : 1, exponent = (i >> 10) & 31, mantissa = i & 1023;
    halves[i] = sign * (exponent === 0 ? mantissa * 2 ** -24
              : exponent === 31 ? (mantissa ? NaN : Infinity)
              : (1 + mantissa / 1024) * 2 ** (exponent - 15));
  }

  const decode = (base64) => {
    const text = atob(base64), values = new Float32Array(text.length / 2);
    for (let i = 0; i < values.length; ++i)
      values[i] = halves[text.charCodeAt(2 * i) | (text.charCodeAt(2 * i + 1) << 8)];
    return values;
  };

  const bytes = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

  const read_image = (i) =>
    ({...i, pixels: decode(i.half), flip: i.flip ? bytes(i.flip) : null});

  const to_srgb = (v) => {
    if (!(v > 0)) return 0;
    if (v >= 1) return 255;
    return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
  };
  const luminance = (p, i) => 0.212671 * p[i] + 0.71516 * p[i + 1] + 0.072169 * p[i + 2];

  /// Fills a pixel with the false colour of t, from 0 to 1; green if it is no number.
  const false_colour = (d, o, t) => {
    if (Number.isNaN(t)) { d[o + 1] = 255; return; }
    const s = Math.min(1, t) * (stops.length - 1), k = Math.min(stops.length - 2, Math.floor(s));
    for (let c = 0; c < 3; ++c) d[o + c] = stops[k][c] + (s - k) * (stops[k + 1][c] - stops[k][c]);
  };

  const element = (name, properties, ...children) => {
    const e = Object.assign(document.createElement(name), properties);
    e.append(...children);
    return e;
  };

  class Viewer {
    constructor(root) {
      this.root = root;
      const data = JSON.parse(root.querySelector("script").textContent);
      Object.assign(this, {width: data.width, height: data.height, reference: data.reference ?? -1});
      this.images = data.images.map(read_image);
      if (this.has_reference()) this.floor = 0.01 * this.mean_of_reference();
      this.shown = this.reference === 0 && this.images.length > 1 ? 1 : 0;
      this.before = this.has_reference() ? this.reference : Math.min(1, this.images.length - 1);
      this.exposure = 0;
      this.map = "";  // or "error" or "flip": what is shown in false colours
      this.zoom = 1;
      this.centre = [this.width / 2, this.height / 2];
      this.source = element("canvas", {width: this.width, height: this.height});
      this.build();
      this.render();
    }

    build() {
      const bar = element("div", {className: "bar"});
      this.buttons = this.images.map((image, i) => {
        const b = element("button", {type: "button", textContent: image.name,
                                     title: i < 9 ? `key ${i + 1}` : ""});
        b.addEventListener("click", () => this.show(i));
        bar.append(b);
        return b;
      });
      bar.append(element("span", {className: "gap"}));
      this.toggle_button = element("button", {type: "button", textContent: "toggle", title: "space"});
      this.toggle_button.addEventListener("click", () => this.show(this.before));
      bar.append(this.toggle_button);
      this.map_buttons = {};
      for (const [kind, name] of [["error", "error"], ["flip", "FLIP"]]) {
        if (kind === "flip" ? !this.has_flip() : !this.has_reference()) continue;
        const b = element("button", {type: "button", textContent: name, title: `key ${kind[0]}`});
        b.addEventListener("click", () => this.toggle_map(kind));
        this.map_buttons[kind] = b;
        bar.append(b);
      }

      const controls = element("div", {className: "bar"});
      this.slider = element("input", {type: "range", min: -8, max: 8, step: 0.25, value: 0});
      this.slider.addEventListener("input", () => this.set_exposure(Number(this.slider.value)));
      this.stops = element("span", {className: "number"});
      const reset = element("button", {type: "button", textContent: "reset", title: "key r"});
      reset.addEventListener("click", () => this.reset());
      const closer = element("button", {type: "button", textContent: "+", title: "wheel"});
      closer.addEventListener("click", () => this.scale(2));
      const wider = element("button", {type: "button", textContent: "−", title: "wheel"});
      wider.addEventListener("click", () => this.scale(0.5));
      this.legend = element("span", {className: "scale"});
      controls.append(element("label", {}, "exposure", this.slider, this.stops),
                      element("label", {}, "zoom", wider, closer), reset,
                      element("span", {className: "gap"}), this.legend);

      this.canvas = element("canvas", {});
      this.note = element("span", {});
      this.readout = element("span", {className: "number"});
      this.root.append(bar, controls, this.canvas,
                       element("div", {className: "info"}, this.note, this.readout));
      this.root.tabIndex = 0;
      this.listen();
    }

    listen() {
      this.root.addEventListener("keydown", (e) => {
        if (e.ctrlKey || e.metaKey || e.altKey) return;
        const n = Number(e.key) - 1;
        if (e.key === " ") { if (e.target.tagName === "BUTTON") return; this.show(this.before); }
        else if (e.key === "e" && this.has_reference()) this.toggle_map("error");
        else if (e.key === "f" && this.has_flip()) this.toggle_map("flip");
        else if (e.key === "r") this.reset();
        else if (n >= 0 && n < this.images.length) this.show(n);
        else return;
        e.preventDefault();
      });
      const c = this.canvas;
      c.addEventListener("pointerdown", (e) => {
        this.root.focus({preventScroll: true});
        c.setPointerCapture(e.pointerId);
        this.drag = [e.clientX, e.clientY];
      });
      c.addEventListener("pointerup", () => { this.drag = null; });
      c.addEventListener("pointermove", (e) => {
        if (this.drag) {
          const s = this.pixel_size() / window.devicePixelRatio;
          this.centre[0] -= (e.clientX - this.drag[0]) / s;
          this.centre[1] -= (e.clientY - this.drag[1]) / s;
          this.drag = [e.clientX, e.clientY];
          this.draw();
        }
        this.pointer = e;
        this.read();
      });
      c.addEventListener("pointerleave", () => { this.pointer = null; this.read(); });
      c.addEventListener("wheel", (e) => {
        if (document.activeElement !== this.root && !e.ctrlKey) return;
        e.preventDefault();
        this.scale(2 ** (-e.deltaY / 300), e);
      }, {passive: false});
      // Not at once: a new size of the canvas is a change that is observed, too.
      new ResizeObserver(() => requestAnimationFrame(() => this.resize())).observe(c);
    }

    mean_of_reference() {
      const p = this.images[this.reference].pixels;
      let sum = 0, count = 0;
      for (let i = 0; i < p.length; i += 3) {
        const y = luminance(p, i);
        if (Number.isFinite(y)) { sum += y; ++count; }
      }
      return sum / Math.max(1, count);
    }

    /// Takes newer images in the place of these; what is looked at, and how, stays.
    update(images) {
      this.images = images.map(read_image);
      this.render();
    }
    show(i) {
      if (i === this.shown) return;
      this.before = this.shown;
      this.shown = i;
      this.render();
    }
    set_exposure(v) { this.exposure = v; this.slider.value = v; this.render(); }
    toggle_map(kind) { this.map = this.map === kind ? "" : kind; this.render(); }
    has_reference() { return this.reference >= 0; }
    has_flip() { return this.images.some((i) => i.flip); }
    reset() {
      this.zoom = 1;
      this.centre = [this.width / 2, this.height / 2];
      this.set_exposure(0);
    }
    scale(factor, at) {
      const zoom = Math.min(64, Math.max(1, this.zoom * factor));
      if (at) {  // what is under the pointer stays there
        const [x, y] = this.position(at);
        for (const [k, p] of [[0, x], [1, y]])
          this.centre[k] = p - (p - this.centre[k]) * this.zoom / zoom;
      }
      this.zoom = zoom;
      this.draw();
    }

    /// Fills the canvas that has the image's own pixels.
    render() {
      const p = this.images[this.shown].pixels, r = this.images[this.reference]?.pixels;
      const flip = this.images[this.shown].flip;
      const context = this.source.getContext("2d");
      const out = context.createImageData(this.width, this.height), d = out.data;
      const scale = 2 ** this.exposure;
      for (let i = 0, o = 0; i < p.length; i += 3, o += 4) {
        d[o + 3] = 255;
        if (this.map === "error") {
          const a = luminance(p, i), b = luminance(r, i);
          false_colour(d, o, a === b ? 0 : scale * Math.abs(a - b) / (Math.abs(b) + this.floor));
        } else if (this.map === "flip") {  // the reference does not differ from itself
          false_colour(d, o, flip ? scale * flip[i / 3] / 255 : 0);
        } else {
          for (let c = 0; c < 3; ++c) d[o + c] = to_srgb(scale * p[i + c]);
        }
      }
      context.putImageData(out, 0, 0);
      this.describe();
      this.draw();
      this.read();
    }

    describe() {
      const image = this.images[this.shown];
      this.root.dataset.shown = image.name;
      this.buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(i === this.shown)));
      for (const [kind, b] of Object.entries(this.map_buttons))
        b.setAttribute("aria-pressed", String(this.map === kind));
      this.toggle_button.textContent = `toggle to ${this.images[this.before].name}`;
      this.toggle_button.hidden = this.images.length < 2;
      this.stops.textContent = (this.exposure > 0 ? "+" : "") + this.exposure.toFixed(2);
      const flip = image.flip ? `mean FLIP ${image.mean_flip.toPrecision(3)}` : "";
      this.note.textContent = [image.note, flip].filter((t) => t).join("; ");
      this.legend.replaceChildren();
      if (!this.map) return;
      const most = 2 ** -this.exposure;
      const text = (v) => v >= 10 ? v.toFixed(0) : String(Number(v.toPrecision(2)));
      this.legend.append(this.map === "flip" ? "FLIP 0" : "difference 0", element("i", {}),
                         this.map === "flip" ? text(most) : `${text(100 * most)} %`);
    }

    resize() {
      const ratio = window.devicePixelRatio, w = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
      const h = Math.round(w * Math.min(this.height / this.width, 0.62));
      if (this.canvas.width === w && this.canvas.height === h) return;
      this.canvas.width = w;
      this.canvas.height = h;
      this.draw();
    }

    /// Size of an image's pixel on the canvas.
    pixel_size() {
      return this.zoom * Math.min(this.canvas.width / this.width, this.canvas.height / this.height);
    }
    /// Where an event is within the image.
    position(e) {
      const box = this.canvas.getBoundingClientRect(), s = this.pixel_size();
      const at = (v, size, pixels, centre) => (v / size * pixels - pixels / 2) / s + centre;
      return [at(e.clientX - box.left, box.width, this.canvas.width, this.centre[0]),
              at(e.clientY - box.top, box.height, this.canvas.height, this.centre[1])];
    }

    draw() {
      const c = this.canvas, context = c.getContext("2d"), s = this.pixel_size();
      const sides = [[0, this.width, c.width], [1, this.height, c.height]];
      for (const [k, size, room] of sides) {  // keep the image in view
        const half = room / (2 * s);
        this.centre[k] = half >= size / 2 ? size / 2 : Math.min(size - half, Math.max(half, this.centre[k]));
      }
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.clearRect(0, 0, c.width, c.height);
      context.imageSmoothingEnabled = s < 1;
      context.setTransform(s, 0, 0, s, c.width / 2 - s * this.centre[0], c.height / 2 - s * this.centre[1]);
      context.drawImage(this.source, 0, 0);
    }

    read() {
      this.readout.textContent = "";
      if (!this.pointer) return;
      const [x, y] = this.position(this.pointer).map(Math.floor);
      if (x < 0 || y < 0 || x >= this.width || y >= this.height) return;
      const i = 3 * (y * this.width + x);
      const text = (p) => [p[i], p[i + 1], p[i + 2]].map((v) => v.toPrecision(3)).join(" ");
      let line = `${x}, ${y}: ${text(this.images[this.shown].pixels)}`;
      if (this.has_reference() && this.shown !== this.reference) line += ` (reference ${text(this.images[this.reference].pixels)})`;
      const flip = this.images[this.shown].flip;
      if (flip) line += `, FLIP ${(flip[i / 3] / 255).toFixed(3)}`;
      this.readout.textContent = line;
    }
  }

  window.make_viewer = (root) => { root.viewer = new Viewer(root); };
  document.querySelectorAll(".viewer").forEach(window.make_viewer);
})();
