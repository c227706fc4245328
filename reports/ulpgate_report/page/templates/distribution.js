// Draws the error distribution of the chosen function as an SVG.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("distributions").textContent);
  const choice = document.getElementById("row");
  const plot = document.getElementById("plot");
  const WIDTH = 900, HEIGHT = 400, LEFT = 70, RIGHT = 20, TOP = 48, BOTTOM = 50;
  const LOWEST = -20, HIGHEST = 64, PER_OCTAVE = 4;
  const SHAPES = [
    "M-4 0a4 4 0 1 0 8 0a4 4 0 1 0 -8 0z", "M-4-4h8v8h-8z", "M0-5l5 9h-10z", "M0-5l5 5l-5 5l-5-5z",
    "M0 5l5-9h-10z", "M-4-4l8 8M4-4l-8 8", "M0-5v10M-5 0h10",
  ];

  function element(name, attributes, text) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    if (text !== undefined) made.textContent = text;
    return made;
  }

  function shares(curve) {
    const [judged, , buckets] = curve;
    const found = new Map();
    buckets.forEach(([index, count]) => {
      const edge = Math.min(Math.max(index, PER_OCTAVE * LOWEST), PER_OCTAVE * HIGHEST);
      found.set(edge, (found.get(edge) || 0) + count / judged);
    });
    return Array.from(found, ([index, share]) => [index / PER_OCTAVE, share]).sort((a, b) => a[0] - b[0]);
  }

  function draw(name) {
    const curves = Object.entries(data.curves[name]).map(([index, curve]) => ({
      index: Number(index), type: data.types[index], exact: curve[1] / curve[0], steps: shares(curve),
    }));
    const edges = curves.flatMap((curve) => curve.steps.map((step) => step[0]));
    const all = curves.flatMap((curve) => curve.steps.map((step) => step[1]).concat(curve.exact || []));
    const low = Math.min(-4, ...edges) - 1, high = Math.max(2, ...edges) + 0.5;
    const bottom = Math.floor(Math.log10(Math.min(0.01, ...all)));
    const x = (octave) => LEFT + ((octave - low) / (high - low)) * (WIDTH - LEFT - RIGHT);
    const y = (share) => TOP + (Math.log10(share) / bottom) * (HEIGHT - TOP - BOTTOM);
    const svg = element("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "font-size": "13", "font-family": "sans-serif" });
    svg.setAttribute("aria-label", "error distribution of " + name);

    const every = [1, 2, 5, 10, 20].find((step) => (high - low) / step <= 14) || 20;
    for (let tick = Math.ceil(low / every) * every; tick <= high; tick += every) {
      svg.append(element("path", { d: `M${x(tick)} ${HEIGHT - BOTTOM}v5`, stroke: "#000" }));
      svg.append(element("text", { x: x(tick), y: HEIGHT - BOTTOM + 19, "text-anchor": "middle" }, String(tick)));
    }
    for (let tick = 0; tick >= bottom; tick -= 1) {
      svg.append(element("path", { d: `M${LEFT} ${y(10 ** tick)}H${WIDTH - RIGHT}`, stroke: "#e4e4e4" }));
      svg.append(element("text", { x: LEFT - 8, y: y(10 ** tick) + 4, "text-anchor": "end" }, "1e" + tick));
    }
    svg.append(element("path", { d: `M${LEFT} ${TOP}V${HEIGHT - BOTTOM}H${WIDTH - RIGHT}`, fill: "none", stroke: "#000" }));
    svg.append(element("path", { d: `M${x(-1)} ${TOP}V${HEIGHT - BOTTOM}`, stroke: "#777", "stroke-dasharray": "2 4" }));
    svg.append(element("text", { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 10, "text-anchor": "middle" }, "error (log2 ULP)"));
    svg.append(element("text", { transform: `translate(16 ${(TOP + HEIGHT - BOTTOM) / 2}) rotate(-90)`, "text-anchor": "middle" },
      "share of judged samples"));

    curves.forEach((curve) => {
      const colour = curve.type.colour;
      const shape = SHAPES[curve.index % SHAPES.length];
      const mark = (px, py) => svg.append(element("path", { d: shape, transform: `translate(${px} ${py})`, fill: colour, stroke: colour }));
      let path = "", before = null;
      curve.steps.forEach(([edge, share]) => {
        const start = edge - 1 / PER_OCTAVE;
        path += (before === start ? "V" + y(share) : `M${x(start)} ${y(share)}`) + "H" + x(edge);
        before = edge;
      });
      const line = element("path", { d: path, fill: "none", stroke: colour, "stroke-width": "1.6" });
      line.append(element("title", {}, curve.type.token));
      svg.append(line);
      if (curve.steps.length) {
        const [edge, share] = curve.steps[curve.steps.length - 1];
        mark(x(edge - 0.5 / PER_OCTAVE), y(share));
      }
      if (curve.exact) mark(LEFT, y(curve.exact));
    });

    let offset = LEFT, level = 14;
    data.types.forEach((type, index) => {
      const width = 44 + 8 * type.token.length;
      if (offset + width > WIDTH) {
        offset = LEFT;
        level += 18;
      }
      const shape = SHAPES[index % SHAPES.length];
      svg.append(element("path", { d: `M${offset} ${level}h22`, stroke: type.colour, "stroke-width": "1.6" }));
      svg.append(element("path", { d: shape, transform: `translate(${offset + 11} ${level})`, fill: type.colour, stroke: type.colour }));
      svg.append(element("text", { x: offset + 28, y: level + 4 }, type.token));
      offset += width;
    });
    plot.replaceChildren(svg);
  }

  // The first one seen is that of the largest error; exact functions have nothing to show.
  function largest(name) {
    const edges = Object.values(data.curves[name]).flatMap((curve) => curve[2].map((bucket) => bucket[0]));
    return Math.max(-Infinity, ...edges);
  }

  const names = Object.keys(data.curves);
  names.forEach((name) => choice.append(new Option(name, name)));
  choice.value = names.reduce((best, name) => (largest(name) > largest(best) ? name : best), names[0]);
  choice.addEventListener("change", () => draw(choice.value));
  if (choice.options.length) draw(choice.value);
})();
