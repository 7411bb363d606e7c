// A page in a notebook, in a frame of its own, whose values stay in step with those of Python.

export default {
  /** @param {{ model: any, el: HTMLElement }} view */
  render({ model, el }) {
    const frame = document.createElement("iframe");
    frame.title = model.get("title");
    frame.srcdoc = model.get("page");
    frame.setAttribute("sandbox", "allow-scripts allow-downloads");
    frame.style.cssText = "width: 100%; height: 84em; border: 0";
    let ready = false; // the first message of a page says that it listens
    let told = ""; // what the page tells is not sent back: it has moved on by then
    const send = () => {
      const values = model.get("values");
      if (JSON.stringify(values) !== told) frame.contentWindow?.postMessage({ rockeom: "set", values }, "*");
    };
    /** @param {MessageEvent} event */
    const receive = ({ source, data }) => {
      if (source !== frame.contentWindow || data?.rockeom !== "values") return;
      if (!ready) {
        ready = true;
        send();
        return;
      }
      told = JSON.stringify(data.values);
      model.set("values", data.values);
      model.save_changes();
    };
    window.addEventListener("message", receive);
    model.on("change:values", send);
    el.append(frame);
    return () => {
      window.removeEventListener("message", receive);
      model.off("change:values", send);
    };
  },
};
