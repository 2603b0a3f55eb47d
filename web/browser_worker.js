// The worker of the page: keeps the compiled work, whose memory holds recordings and results as files.
"use strict";
let work = null;

function emptied(folder) {
  const fs = work.FS;
  if (!fs.analyzePath(folder).exists) fs.mkdir(folder);
  for (const name of fs.readdir(folder)) {
    if (name !== "." && name !== "..") fs.unlink(folder + "/" + name);
  }
}

async function begin(wasm) {
  work = await hysteronWork({
    wasmBinary: wasm,
    locateFile: (name) => name,
    onProgress: (stage, share, detail) => postMessage({ kind: "progress", stage, share, detail }),
  });
}

// Files, then one request; the answer, with the bytes of the results.
function answered(message) {
  emptied("/recordings");
  emptied("/results");
  for (const file of message.files || []) work.FS.writeFile("/recordings/" + file.name, file.bytes);
  const answer = JSON.parse(work.ccall("hysteron_do", "string", ["string"], [JSON.stringify(message.request)]));
  const results = (answer.files || []).map((name) => ({ name, bytes: work.FS.readFile("/results/" + name) }));
  return { kind: "answer", id: message.id, answer, results };
}

onmessage = async (event) => {
  const message = event.data;
  try {
    if (message.wasm) await begin(message.wasm);
    postMessage(message.wasm ? { kind: "ready" } : answered(message));
  } catch (error) {
    // Out of memory, or a browser without what the compiled work needs.
    postMessage({ kind: "answer", id: message.id, answer: { error: "the work cannot go on in this browser: " + error }, results: [] });
  }
};
