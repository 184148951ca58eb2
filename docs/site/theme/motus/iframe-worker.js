// The worker of the site's search, which is asked for what a reader means rather than for what was typed.
// Browsers start no Worker from a site that is opened from disk: there the worker's script runs in a hidden frame instead.
// Material for MkDocs looks for the name IFrameWorker, in the page and in the script's parent.
"use strict";

class IFrameWorker extends EventTarget {
  constructor(url) {
    super();
    this.frame = document.createElement("iframe");
    this.frame.hidden = true;
    document.body.append(this.frame);
    const inside = this.frame.contentWindow;
    window.addEventListener("message", (event) => {
      if (event.source !== inside) return;
      this.dispatchEvent(new MessageEvent("message", { data: event.data }));
    });
    inside.document.open();
    inside.document.write(`<html><body><script>
      postMessage = (data) => parent.postMessage(data, "*");
      importScripts = (...urls) => urls.reduce((before, url) => before.then(() => new Promise((done) => {
        document.body.append(Object.assign(document.createElement("script"), { src: url, onload: done }));
      })), Promise.resolve());
    <\/script><script src="${url}"><\/script></body></html>`);
    inside.document.close();
    this.ready = new Promise((done) => { inside.onload = done; });
  }

  async postMessage(data) {
    await this.ready;
    this.frame.contentWindow.dispatchEvent(new MessageEvent("message", { data: structuredClone(data) }));
  }

  terminate() {
    this.frame.remove();
  }
}

window.IFrameWorker = IFrameWorker;

{
  const EMPTY = new Set((
    "a an and are as at be by can do does for from how i in into is it make my of on or so that the this to want what when where which why with "
    + "al cómo como con de del el en es hacer la las lo los me mi para por que se sin su un una y"
  ).split(" "));

  // The search completes words, so that "flip" finds "flips" and "flipping".
  const shorter = (word) => word.replace(/^(.{4,})(?:ing|ed)$/, "$1").replace(/^(.{3,}[^s])s$/, "$1");

  const meant = (typed) => {
    if (/["+~^:*-]/.test(typed)) return typed;
    const words = typed.toLowerCase().split(/\s+/).filter((word) => word && !EMPTY.has(word));
    return words.length ? words.map(shorter).join(" ") : typed;
  };

  const QUERY = 2; // of the messages that Material for MkDocs sends to its worker
  window.Worker = class extends (location.protocol === "file:" ? IFrameWorker : Worker) {
    postMessage(message, ...rest) {
      return super.postMessage(message.type === QUERY ? { ...message, data: meant(message.data) } : message, ...rest);
    }
  };
}
