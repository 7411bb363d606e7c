// A page in a notebook, in a frame of its own, whose values stay in step with those of Python.

export default {
  /** @param {{ model: any, el: HTMLElement }} view */
  render({ model, el }) {
    const frame = document.createElement("iframe");
    frame.title = model.get("title");
    frame.srcdoc = model.get("page");
    frame.setAttribute("sandbox", "allow-scripts allow-downloads");
    frame.style.cssText = "width: 100%; height: 72em; border: 0";
    const send = () => frame.contentWindow?.postMessage({ rockeom: "set", values: model.get("values") }, "*");
    /** @param {MessageEvent} event */
    const receive = ({ source, data }) => {
      if (source !== frame.contentWindow || data?.rockeom !== "values") return;
      model.set("values", data.values);
      model.save_changes();
    };
    window.addEventListener("message", receive);
    frame.addEventListener("load", send);
    model.on("change:values", send);
    el.append(frame);
    return () => {
      window.removeEventListener("message", receive);
      model.off("change:values", send);
    };
  },
};
