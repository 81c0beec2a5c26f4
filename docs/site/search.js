// SPDX-License-Identifier: GPL-2.0-or-later
// Sphinx's search fetches each page that it has found, to show the words in their context. Browsers
// fetch nothing from a folder: such requests are answered from texts.js, which has the words of all
// pages, on a server too, where one file is quicker than forty.
"use strict";
{
  const ask = window.fetch.bind(window);
  const root = new URL(".", document.location);
  window.fetch = (request, ...more) => {
    const address = new URL(request, root);
    const text = window.TEXTS[address.href.slice(root.href.length)];
    return text === undefined ? ask(request, ...more) : Promise.resolve(new Response(text));
  };
}
