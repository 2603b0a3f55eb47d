// The page of fit and diagnose in the browser: hands recordings to the worker, shows what comes back.
"use strict";
(() => {
  const get = (id) => document.getElementById(id);
  const state = { files: new Map(), catalogue: null, look: null, busy: false, urls: [] };
  let worker = null;
  let waiting = null; // of the one question under way
  let wasm = null;
  let script = null;

  async function unpacked(id) {
    const packed = Uint8Array.from(atob(get(id).textContent.trim()), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  // A worker that is ended takes its work with it; the next one begins from the same bytes.
  function started() {
    return new Promise((resolve, reject) => {
      worker = new Worker(script);
      worker.onerror = (event) => reject(new Error(event.message || "the worker does not start"));
      worker.onmessage = ({ data }) => {
        if (data.kind === "ready") return resolve();
        if (data.kind === "progress") return progress(data);
        if (!waiting) return reject(new Error(data.answer.error));
        const { settle } = waiting;
        waiting = null;
        settle(data);
      };
      worker.postMessage({ wasm });
    });
  }

  function ask(request) {
    const files = [...state.files].map(([name, bytes]) => ({ name, bytes }));
    return new Promise((settle) => {
      waiting = { settle };
      worker.postMessage({ id: 1, request, files });
    });
  }

  function element(tag, text, className) {
    const node = document.createElement(tag);
    if (text !== undefined) node.textContent = text;
    if (className) node.className = className;
    return node;
  }

  function show(error) {
    get("error").hidden = !error;
    get("error").textContent = error || "";
  }

  function progress({ stage, share, detail }) {
    get("bar").value = Math.min(1, Math.max(0, share));
    get("stage").textContent = detail ? stage + ": " + detail : stage;
  }

  function table(rows) {
    const box = element("div", undefined, "scroll tall");
    box.tabIndex = 0;
    box.setAttribute("role", "region");
    box.setAttribute("aria-label", "Recordings");
    const whole = element("table");
    const head = element("tr");
    for (const [text, kind] of [["Recording", ""], ["Samples", "num"], ["Length [s]", "num"], ["Stroke [mm]", "num"], ["Peak [N]", "num"]]) {
      const cell = element("th", text, kind);
      cell.scope = "col";
      head.append(cell);
    }
    const top = element("thead");
    top.append(head);
    const body = element("tbody");
    for (const row of rows) {
      const line = element("tr");
      const name = element("th", row.file);
      name.scope = "row";
      line.append(name, ...[row.samples, row.seconds, row.stroke_mm, row.peak_n].map((value) => element("td", String(value), "num")));
      body.append(line);
    }
    whole.append(top, body);
    box.append(whole);
    return box;
  }

  function warnings(list) {
    if (!list || list.length === 0) return [];
    const box = element("div", undefined, "warning");
    const lines = element("ul");
    lines.append(...list.map((text) => element("li", text)));
    box.append(lines);
    return [box];
  }

  function ready() {
    get("start").disabled = !state.catalogue || state.files.size === 0 || state.busy || !state.look;
    get("clear").hidden = state.files.size === 0;
  }

  async function look() {
    state.look = null;
    show("");
    ready();
    if (state.files.size === 0 || state.busy || !state.catalogue) return get("look").replaceChildren();
    state.busy = true;
    const { answer } = await ask({ work: "look" });
    state.busy = false;
    if (answer.error) {
      get("look").replaceChildren();
      show(answer.error);
      return ready();
    }
    state.look = answer;
    get("look").replaceChildren(table(answer.recordings), ...warnings(answer.warnings));
    get("drive").textContent = answer.drive ? "the " + answer.drive : "the current (none is recorded)";
    if (answer.model && [...get("model").options].some((option) => option.value === answer.model)) {
      get("model").value = answer.model;
      describe();
    }
    ready();
  }

  async function take(list) {
    if (state.busy) return;
    for (const file of list) {
      if (!/^(README.*|LICENSE|SHA256SUMS)$/i.test(file.name)) state.files.set(file.name, new Uint8Array(await file.arrayBuffer()));
    }
    await look();
  }

  function describe() {
    const model = state.catalogue.models.find(({ id }) => id === get("model").value);
    get("parameters").textContent = model ? "Parameters: " + model.parameters.map(({ name, meaning }) => name + " (" + meaning + ")").join(", ") + "." : "";
  }

  // "alpha:1,c0:2" as orders; throws what is wrong.
  function laws(text) {
    const orders = {};
    for (const part of text.split(",").map((word) => word.trim()).filter(Boolean)) {
      const match = /^([^:]+):(\d+)$/.exec(part);
      if (!match) throw new Error("'" + part + "' is no parameter with an order, expected alpha:1,c0:1");
      orders[match[1].trim()] = Number(match[2]);
    }
    return orders;
  }

  function request() {
    const work = new FormData(get("form")).get("work");
    const asked = { work, model: get("model").value, seed: Number(get("seed").value) };
    const orders = laws(get("laws").value);
    if (Object.keys(orders).length > 0) asked.by = { current: orders };
    if (work === "fit") asked.budget = Number(get("budget").value);
    return asked;
  }

  function busy(on) {
    state.busy = on;
    get("progress").hidden = !on;
    get("stop").hidden = !on;
    ready();
  }

  function results(list) {
    for (const url of state.urls) URL.revokeObjectURL(url);
    state.urls = [];
    const links = list.map(({ name, bytes }) => {
      const type = name.endsWith(".html") ? "text/html" : "application/json";
      const url = URL.createObjectURL(new Blob([bytes], { type }));
      state.urls.push(url);
      // In the frame the links within the report must not lead to this page.
      if (name === "report.html") get("report").srcdoc = new TextDecoder().decode(bytes).replace("<head>", '<head><base href="about:srcdoc">');
      const link = element("a", name);
      link.href = url;
      link.download = name;
      return link;
    });
    const whole = element("a", "Open in a tab of its own");
    whole.href = state.urls[list.findIndex(({ name }) => name === "report.html")];
    whole.target = "_blank";
    get("saves").replaceChildren(whole, "Save: ", ...links);
    get("done").hidden = false;
  }

  async function run(event) {
    event.preventDefault();
    show("");
    let asked;
    try {
      asked = request();
    } catch (error) {
      return show(error.message);
    }
    get("done").hidden = true;
    busy(true);
    progress({ stage: "reading", share: 0, detail: "" });
    const begun = performance.now();
    const { answer, results: files } = await ask(asked);
    busy(false);
    state.seconds = (performance.now() - begun) / 1000;
    state.results = files;
    if (answer.error) return show(answer.error);
    results(files);
  }

  async function stop() {
    worker.terminate();
    waiting = null;
    await started();
    busy(false);
    show("Stopped; nothing is kept of the unfinished work.");
  }

  async function begin() {
    try {
      wasm = await unpacked("wasm");
      script = URL.createObjectURL(new Blob([await unpacked("worker")], { type: "text/javascript" }));
      await started();
    } catch (error) {
      return show("This browser lacks what the page needs (WebAssembly with exceptions and SIMD, DecompressionStream): " + error.message);
    }
    state.catalogue = (await ask({ work: "catalogue" })).answer;
    get("model").replaceChildren(...state.catalogue.models.map(({ id, title }) => {
      const option = element("option", id + " (" + title + ")");
      option.value = id;
      return option;
    }));
    get("model").value = "bouc-wen";
    describe();
    await look();
    document.documentElement.dataset.ready = "1";
  }

  const drop = get("drop");
  for (const kind of ["dragenter", "dragover"]) {
    drop.addEventListener(kind, (event) => { event.preventDefault(); drop.classList.add("over"); });
  }
  for (const kind of ["dragleave", "drop"]) drop.addEventListener(kind, () => drop.classList.remove("over"));
  drop.addEventListener("drop", (event) => { event.preventDefault(); take(event.dataTransfer.files); });
  get("files").addEventListener("change", () => take(get("files").files));
  get("clear").addEventListener("click", () => { state.files.clear(); get("files").value = ""; look(); });
  get("model").addEventListener("change", describe);
  get("form").addEventListener("submit", run);
  get("form").addEventListener("change", () => {
    for (const node of document.querySelectorAll(".only-fit")) node.hidden = new FormData(get("form")).get("work") !== "fit";
  });
  get("stop").addEventListener("click", stop);
  window.hysteronPage = { state, take };
  begin();
})();
