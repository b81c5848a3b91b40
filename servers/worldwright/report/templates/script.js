(() => {
  "use strict";
  const all = (selector, from = document) => [...from.querySelectorAll(selector)];
  const one = (selector) => document.querySelector(selector);

  // light or dark
  const root = document.documentElement;
  one(".theme")?.addEventListener("click", () => {
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  });

  // copy a command
  all(".command").forEach((code) => code.addEventListener("click", async () => {
    try { await navigator.clipboard.writeText(code.textContent); } catch { return; }
    code.classList.add("copied");
    setTimeout(() => code.classList.remove("copied"), 1200);
  }));

  // cameras: one picture at a time, all at the same moment
  const films = all(".player video");
  const shown = () => films.find((film) => !film.hidden);
  // an author's film has times of its own: its shots tell which recorded moment each shows
  const shots = (film) => JSON.parse(film.dataset.shots || "[]");
  const recordedAt = (film) => {
    const time = film.currentTime, shot = shots(film).findLast((s) => s.film_s <= time);
    return shot ? shot.from_s + (time - shot.film_s) / shot.seconds * (shot.to_s - shot.from_s) : time;
  };
  const filmAt = (film, time) => {
    const all = shots(film), shot = all.find((s) => s.from_s <= time && time <= s.to_s) || all.find((s) => s.from_s > time) || all.at(-1);
    if (!shot) return time;
    const share = shot.to_s > shot.from_s ? (time - shot.from_s) / (shot.to_s - shot.from_s) : 0;
    return shot.film_s + shot.seconds * Math.min(1, Math.max(0, share));
  };
  all(".cameras button").forEach((button) => button.addEventListener("click", () => {
    const before = shown();
    all(".cameras button").forEach((b) => b.setAttribute("aria-pressed", String(b === button)));
    all(".player [data-camera]:not(button)").forEach((view) => { view.hidden = view.dataset.camera !== button.dataset.camera; });
    const now = shown();
    if (before && now && before !== now) {
      const playing = !before.paused;
      before.pause();
      now.currentTime = filmAt(now, recordedAt(before));
      if (playing) now.play().catch(() => {});
    }
  }));

  // one time cursor over every plot, following the video and moving it
  const motion = one("#motion");
  const end = motion ? Number(motion.dataset.end) : 0;
  const curves = all(".chart polyline[data-name]").map((line) => {
    const chart = line.closest(".chart");
    const points = line.getAttribute("points").split(" ").filter(Boolean).map((p) => p.split(",").map(Number));
    const [y0, y1] = [Number(chart.dataset.y0), Number(chart.dataset.y1)];
    const entry = all(".legend li", chart).find((li) => li.dataset.name === line.dataset.name);
    return { points, y0, y1, unit: chart.dataset.unit, output: entry?.querySelector("output") };
  }).filter((curve) => curve.output && curve.points.length);

  const valueAt = (curve, time) => {
    const x = 1000 * time / end, { points } = curve;
    let low = 0, high = points.length - 1;
    while (high - low > 1) { const mid = (low + high) >> 1; if (points[mid][0] <= x) low = mid; else high = mid; }
    const [a, b] = [points[low], points[high]];
    const share = b[0] > a[0] ? Math.min(1, Math.max(0, (x - a[0]) / (b[0] - a[0]))) : 0;
    const y = a[1] + share * (b[1] - a[1]);
    return curve.y0 + (1000 - y) / 1000 * (curve.y1 - curve.y0);
  };
  const digits = (value, span) => value.toFixed(Math.max(0, Math.min(4, 2 - Math.floor(Math.log10(span || 1))))).replace("-", "−");

  let drawn = -1;
  const show = (time) => {
    if (!end || Math.abs(time - drawn) < 1e-4) return;
    drawn = time;
    motion.classList.add("live");
    const left = `${Math.min(100, 100 * time / end)}%`;
    all(".cursor", motion).forEach((cursor) => { cursor.style.left = left; });
    curves.forEach((curve) => { curve.output.textContent = `${digits(valueAt(curve, time), curve.y1 - curve.y0)} ${curve.unit}`; });
  };
  const seek = (time) => {
    const film = shown();
    if (film && film.readyState > 0) film.currentTime = Math.min(filmAt(film, time), Math.max(0, film.duration - 0.01));
    show(time);
  };
  const follow = () => {
    const film = shown();
    if (film && !film.paused) show(recordedAt(film));
    requestAnimationFrame(follow);
  };
  if (end) {
    all("#motion .area").forEach((area) => {
      const at = (event) => {
        const box = area.getBoundingClientRect();
        return end * Math.min(1, Math.max(0, (event.clientX - box.left) / box.width));
      };
      area.addEventListener("pointermove", (event) => { if (event.pointerType === "mouse") { shown()?.pause(); seek(at(event)); } });
      area.addEventListener("pointerdown", (event) => { shown()?.pause(); seek(at(event)); });
    });
    films.forEach((film) => film.addEventListener("seeked", () => { if (!film.hidden && film.paused) show(recordedAt(film)); }));
    requestAnimationFrame(follow);
  }
  all("[data-seek]").forEach((button) => button.addEventListener("click", () => { shown()?.pause(); seek(Number(button.dataset.seek)); }));

  // the video stays in sight while the plots are read
  const stage = one("#stage"), player = one(".player");
  if (stage && player && films.length && motion && "IntersectionObserver" in window) {
    const seen = new Map([[stage, true], [motion, false]]);
    const watch = new IntersectionObserver((entries) => {
      entries.forEach((entry) => seen.set(entry.target, entry.isIntersecting));
      player.classList.toggle("pip", innerWidth >= 900 && !seen.get(stage) && seen.get(motion));
    });
    [stage, motion].forEach((part) => watch.observe(part));
  }

  // a picture, larger
  const large = document.createElement("dialog");
  large.append(new Image());
  document.body.append(large);
  large.addEventListener("click", () => large.close());
  all(".gallery img, .paper img").forEach((picture) => picture.addEventListener("click", () => {
    [large.firstChild.src, large.firstChild.alt] = [picture.src, picture.alt];
    large.showModal();
  }));

  // printing shows everything
  addEventListener("beforeprint", () => all("details").forEach((d) => { d.dataset.was = d.open; d.open = true; }));
  addEventListener("afterprint", () => all("details").forEach((d) => { d.open = d.dataset.was === "true"; }));
})();
