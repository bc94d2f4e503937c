"use strict";
// Keeps the page of `duet render --live` up to date: asks for the image that follows the one it has.
(() => {
  const pause = 500, pause_without_answer = 2000;  // in milliseconds
  let number = 0;

  const say = (text) => { document.getElementById("state").textContent = text; };

  const show = (data) => {
    number = data.number;
    say(data.state);
    document.title = `${data.name} – Duet`;
    const {width, height, images} = data.viewer;
    const layout = JSON.stringify([data.name, width, height, images.map((i) => i.name)]);
    const old = document.querySelector(".viewer");
    if (old && old.dataset.layout === layout) {
      old.viewer.update(images);
      return;
    }
    const root = document.createElement("div"), script = document.createElement("script");
    script.type = "application/json";
    script.textContent = JSON.stringify(data.viewer);
    root.className = "viewer";
    root.dataset.layout = layout;
    root.append(script);
    document.getElementById("image").replaceChildren(root);
    window.make_viewer(root);
  };

  const ask = async () => {
    let next = pause;
    try {
      const answer = await fetch(`image?after=${number}`);
      if (answer.status === 200) show(await answer.json());
    } catch {  // the next render at this port counts from one again
      if (number > 0) say("The render has ended; this is the last image that came from it.");
      number = 0;
      next = pause_without_answer;
    }
    setTimeout(ask, next);
  };
  addEventListener("DOMContentLoaded", ask);
})();
