// The player of an animation. R/animate-page.R writes it into each page, calls play() with the
// element, and closes the function: nothing is shared by two animations.
(function () {
"use strict";
function play(root, fills, inks) {
  var film = JSON.parse(root.querySelector("script[type='application/json']").textContent);
  var find = function (name) { return root.querySelector("." + name); };
  var svg = find("stage"), slider = find("time"), clock = find("clock"), live = find("live");
  var says = find("says"), button = find("play"), speed = find("speed");
  var beside = find("beside"), above = find("above");
  var cells = root.querySelectorAll(".values .x");
  var last = film.time.length - 1, now = 0, playing = false, from = 0, began = 0, told = 0;
  var still = window.matchMedia("(prefers-reduced-motion: reduce)");
  var space = film.space !== 0, half = film.half, view = null;
  var ns = "http://www.w3.org/2000/svg";

  svg.setAttribute("viewBox", [-half[0], -half[1], 2 * half[0], 2 * half[1]].join(" "));
  var picture = svg.appendChild(document.createElementNS(ns, "g"));
  var letters = svg.appendChild(document.createElementNS(ns, "g"));

  // Points of a track: a flat list, or an arc.
  function expand(p) {
    if (!p.a) return p;
    var a = p.a, out = [], turn = Math.PI / 180;
    var n = Math.max(2, Math.ceil(Math.abs(a[4] - a[3]) / 5));
    for (var i = 0; i <= n; i++) {
      var angle = (a[3] + (a[4] - a[3]) * i / n) * turn;
      out.push(a[0] + a[2] * Math.cos(angle), a[1] + a[2] * Math.sin(angle));
    }
    return out;
  }
  function moved(p, map) {
    var out = new Array(p.length), i;
    if (space) {
      for (i = 0; i < p.length; i += 3) {
        for (var j = 0; j < 3; j++) {
          out[i + j] = (map[j] * p[i] + map[3 + j] * p[i + 1] + map[6 + j] * p[i + 2]) / 1e4 +
            map[9 + j];
        }
      }
    } else {
      for (i = 0; i < p.length; i += 2) {
        out[i] = (map[0] * p[i] + map[2] * p[i + 1]) / 1e4 + map[4];
        out[i + 1] = (map[1] * p[i] + map[3] * p[i + 1]) / 1e4 + map[5];
      }
    }
    return out;
  }
  // The points of a track in frame i, or null.
  function points_of(track, i) {
    var d = space ? 3 : 2;
    if (track.trail) {
      return track.trail.slice(d * Math.max(0, i - track.w), d * (i + 1));
    }
    if (track.f) return track.f[i] === 0 ? null : expand(track.f[i]);
    if (!track.base) track.base = expand(track.p);
    if (track.of === undefined) return track.base;
    var n = d * (d + 1), all = film.moves[track.of];
    return moved(track.base, all.slice(n * i, n * (i + 1)));
  }

  // Rows: to the right, up, towards the reader, as whole_view() of R/draw-space.R.
  function look() {
    var b = beside.value * Math.PI / 180, a = above.value * Math.PI / 180;
    view = [
      [-Math.sin(b), Math.cos(b), 0],
      [-Math.cos(b) * Math.sin(a), -Math.sin(b) * Math.sin(a), Math.cos(a)],
      [Math.cos(b) * Math.cos(a), Math.sin(b) * Math.cos(a), Math.sin(a)]
    ];
  }
  function along(row, p, i) { return row[0] * p[i] + row[1] * p[i + 1] + row[2] * p[i + 2]; }
  function flat(p) {
    var out = [];
    for (var i = 0; i < p.length; i += 3) out.push(along(view[0], p, i), along(view[1], p, i));
    return out;
  }
  function area(p) {
    var sum = 0, n = p.length;
    for (var i = 0; i < n; i += 2) {
      sum += p[i] * p[(i + 3) % n] - p[(i + 2) % n] * p[i + 1];
    }
    return sum;
  }

  function path_of(p, closed) {
    var text = "";
    for (var i = 0; i < p.length; i += 2) {
      text += (i ? "L" : "M") + Math.round(p[i]) + " " + Math.round(-p[i + 1]);
    }
    return text + (closed ? "Z" : "");
  }
  // The head of an arrow, a triangle of the size of a letter.
  function head_of(p, size) {
    var n = p.length, x = p[n - 2], y = p[n - 1], k = n - 4;
    // Along an arc, from where the head begins.
    while (k > 0 && Math.hypot(x - p[k], y - p[k + 1]) < 0.8 * size) k -= 2;
    var dx = x - p[k], dy = y - p[k + 1], long = Math.hypot(dx, dy);
    if (long < 1) return "";
    var s = Math.min(size, 0.7 * long) / long, w = 0.36;
    dx *= s; dy *= s;
    return path_of([x, y, x - dx - w * dy, y - dy + w * dx, x - dx + w * dy, y - dy - w * dx], true);
  }

  function shape(parent, style, filled, edged) {
    var one = parent.appendChild(document.createElementNS(ns, "path"));
    var dashed = style === "dashed" || style === "hole";
    var line = fills["line-" + style] || "#777777";
    one.setAttribute("fill", filled ? fills[style] || style : "none");
    one.setAttribute("stroke", filled ? edged ? "#404040" : fills[style] || style : line);
    one.setAttribute("stroke-width", filled ? edged ? 1 : 0.6 : 2);
    one.setAttribute("stroke-linejoin", "round");
    one.setAttribute("vector-effect", "non-scaling-stroke");
    if (dashed) one.setAttribute("stroke-dasharray", "5 4");
    return one;
  }
  film.marks.forEach(function (track) {
    var filled = track.k === "fill" || track.k === "face";
    track.node = shape(picture, track.s, filled, !space || track.e === 1);
    if (track.k === "arrow") {
      track.head = shape(picture, track.s, false);
      track.head.setAttribute("fill", track.head.getAttribute("stroke"));
    }
    if (track.trail && space) track.behind = shape(picture, track.s, false);
  });
  film.labels.forEach(function (label) {
    label.node = letters.appendChild(document.createElementNS(ns, "text"));
    label.node.setAttribute("fill", inks[label.s] || "#333333");
    label.node.setAttribute("text-anchor", label.h === 0 ? "start" : label.h === 1 ? "end" : "middle");
    label.node.setAttribute("dominant-baseline", "middle");
    var base = label.node.appendChild(document.createElementNS(ns, "tspan"));
    base.textContent = label.t[0];
    if (label.word) label.node.setAttribute("class", "word");
    else base.setAttribute("font-style", "italic");
    if (label.t[1]) {
      var low = label.node.appendChild(document.createElementNS(ns, "tspan"));
      low.textContent = label.t[1];
      low.setAttribute("font-size", "70%");
      low.setAttribute("dy", "0.3em");
    }
  });

  // Letters and heads keep their size on the screen.
  var unit = 8;
  function measure() {
    var wide = svg.clientWidth, high = svg.clientHeight;
    if (wide && high) unit = Math.max(2 * half[0] / wide, 2 * half[1] / high);
    letters.setAttribute("font-size", 17 * unit);
  }

  function show(node, text) {
    if (text) { node.setAttribute("d", text); node.removeAttribute("display"); }
    else node.setAttribute("display", "none");
  }
  function draw() {
    var depth = {}, count = {}, seen = [];
    film.marks.forEach(function (track) {
      var p = points_of(track, now);
      if (space && p && !track.trail) {
        if (depth[track.part] === undefined) depth[track.part] = count[track.part] = 0;
        for (var i = 0; i < p.length; i += 3) {
          depth[track.part] += along(view[2], p, i);
          count[track.part]++;
        }
      }
      seen.push(p);
    });
    film.marks.forEach(function (track, k) {
      var p = seen[k], closed = track.k === "fill" || track.k === "face";
      if (p && space) {
        if (track.trail) { trail(track, p); return; }
        p = flat(p);
        if (track.k === "face" && area(p) <= 0) p = null;
      }
      show(track.node, p && path_of(p, closed));
      if (track.head) show(track.head, p && head_of(p, 11 * unit));
    });
    if (space) sort(depth, count);
    film.labels.forEach(function (label) {
      var at = label.at.length === 1 ? label.at[0] : label.at[now];
      if (at === 0) { label.node.setAttribute("display", "none"); return; }
      if (space) at = beyond(flat(at), label.aside);
      label.node.removeAttribute("display");
      label.node.setAttribute("x", at[0]);
      label.node.setAttribute("y", -at[1]);
    });
  }
  // Beyond a point, seen from the origin, or beside that line.
  function beyond(at, aside) {
    var gap = film.gap[0], long = Math.hypot(at[0], at[1]);
    var way = long < gap ? [0, 1] : [at[0] / long, at[1] / long];
    if (aside) way = [-way[1], way[0]];
    return [at[0] + gap * way[0], at[1] + gap * way[1]];
  }
  // What lies behind the origin goes before all parts.
  function trail(track, p) {
    var front = "", back = "", before = null;
    for (var i = 0; i < p.length; i += 3) {
      var far = along(view[2], p, i) < 0, x = Math.round(along(view[0], p, i));
      var at = x + " " + Math.round(-along(view[1], p, i));
      if (before) {
        if (far) back += "M" + before + "L" + at; else front += "M" + before + "L" + at;
      }
      before = at;
    }
    show(track.node, front);
    show(track.behind, back);
  }
  function sort(depth, count) {
    var rank = function (track) {
      if (track.part === "behind") return -Infinity;
      if (track.part === "over") return Infinity;
      return depth[track.part] / count[track.part];
    };
    var order = film.marks.map(function (track, k) { return [rank(track), k, track]; });
    order.sort(function (a, b) { return a[0] === b[0] ? a[1] - b[1] : a[0] < b[0] ? -1 : 1; });
    film.marks.forEach(function (track) {
      if (track.behind) picture.appendChild(track.behind);
    });
    order.forEach(function (one) {
      picture.appendChild(one[2].node);
      if (one[2].head) picture.appendChild(one[2].head);
    });
  }

  function digits(x) { return x === null ? "\u2013" : String(Number(x.toPrecision(4))); }
  function time_text() { return film.time[now].toFixed(film.digits); }
  function word() { return film.says === 0 ? film.words[0] : film.words[film.says[now]]; }
  function update() {
    draw();
    slider.value = now;
    slider.setAttribute("aria-valuetext", time_text() + " seconds");
    clock.textContent = "t = " + time_text() + " s";
    says.textContent = word();
    film.values.forEach(function (one, k) { cells[k].textContent = digits(one.x[now]); });
    root.setAttribute("data-frame", now);
  }
  // One sentence for screen readers, half a second after the last input.
  function tell() {
    window.clearTimeout(told);
    told = window.setTimeout(function () {
      var parts = film.values.map(function (one) {
        return one.label + " " + digits(one.x[now]) + " " + one.unit;
      });
      var text = (playing ? "Plays. " : "") + "Time " + time_text() + " seconds. " +
        (word() ? word() + ". " : "") + (playing ? "" : parts.join("; "));
      if (live.textContent !== text) live.textContent = text;
    }, 500);
  }
  function go(to) {
    now = Math.max(0, Math.min(last, to));
    update();
  }
  // Until the next picture: seconds of film since play began, at the chosen speed.
  function tick(at) {
    if (!playing) return;
    var gone = (at - began) / 1000 * speed.value / film.slow;
    // Reduced motion: two pictures a second.
    if (still.matches) {
      var step = 0.5 * speed.value / film.slow;
      gone = step * Math.floor(gone / step);
    }
    var time = film.time[from] + gone, to = now;
    while (to < last && film.time[to + 1] <= time) to++;
    if (to !== now) go(to);
    if (now === last) set_playing(false); else window.requestAnimationFrame(tick);
  }
  function set_playing(on) {
    playing = on;
    button.textContent = on ? "Pause" : "Play";
    root.setAttribute("data-playing", on ? "1" : "0");
    if (on) {
      if (now === last) go(0);
      from = now;
      began = window.performance.now();
      window.requestAnimationFrame(tick);
    }
    tell();
  }
  function step(by) { jump(now + by); }
  function jump(to) {
    if (playing) set_playing(false);
    go(to);
    tell();
  }
  speed.addEventListener("change", function () {
    from = now;
    began = window.performance.now();
  });
  slider.addEventListener("input", function () { jump(Number(slider.value)); });
  var doing = {
    first: function () { jump(0); }, back: function () { step(-1); },
    play: function () { set_playing(!playing); }, on: function () { step(1); },
    last: function () { jump(last); }
  };
  root.addEventListener("click", function (event) {
    var name = event.target.getAttribute("data-do");
    if (name) doing[name]();
  });
  var keys = {
    ArrowRight: function () { step(1); }, ArrowLeft: function () { step(-1); },
    ArrowUp: function () { step(1); }, ArrowDown: function () { step(-1); },
    PageUp: function () { step(10); }, PageDown: function () { step(-10); },
    Home: function () { jump(0); }, End: function () { jump(last); },
    " ": function () { set_playing(!playing); }
  };
  function key(event) {
    var at = event.target, name = event.key;
    if (event.altKey || event.ctrlKey || event.metaKey || !keys.hasOwnProperty(name)) return;
    // Buttons, the list and the sliders of the view have these keys themselves.
    if (name === " " && at.tagName === "BUTTON") return;
    if (at === speed || ((at === beside || at === above) && name !== " ")) return;
    event.preventDefault();
    keys[name]();
  }
  (root.getAttribute("data-alone") ? document : root).addEventListener("keydown", key);

  if (space) {
    var turned = function () { look(); draw(); };
    beside.addEventListener("input", turned);
    above.addEventListener("input", turned);
    var held = null;
    svg.addEventListener("pointerdown", function (event) {
      held = [event.clientX, event.clientY, Number(beside.value), Number(above.value)];
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", function (event) {
      if (!held) return;
      var angle = held[2] - 0.5 * (event.clientX - held[0]);
      beside.value = angle - 360 * Math.round(angle / 360);
      above.value = held[3] + 0.5 * (event.clientY - held[1]);
      turned();
    });
    svg.addEventListener("pointerup", function () { held = null; });
    svg.addEventListener("pointercancel", function () { held = null; });
    look();
  }
  if (window.ResizeObserver) {
    new window.ResizeObserver(function () { measure(); draw(); }).observe(svg);
  }
  measure();
  update();
}
