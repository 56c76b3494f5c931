// Browsers let a page from the disk start no worker and fetch no file. Then the site's search runs in the page itself, with
// its index as a script (search/search_index.js, by scripts/mkdocs_hooks.py). Also shows the answers to index.html?q=WORDS.
(function () {
  function loaded(script) {
    return new Promise(function (resolve, reject) {
      const element = document.createElement('script');
      element.src = base_url + '/search/' + script;
      element.onload = resolve;
      element.onerror = reject;
      document.head.append(element);
    });
  }

  function showAnswers() {
    if (new URLSearchParams(location.search).has('q')) $('#mkdocs_search_modal').modal('show');
  }

  // What search/main.js and search/worker.js do without workers, less what they fetch.
  async function searchInPage() {
    for (const script of ['lunr.js', 'search_index.js', 'worker.js']) await loaded(script);
    window.postMessage = function (message) { onWorkerMessage({ data: message }); };
    data = search_index;
    onScriptsLoaded();
    showAnswers();
  }

  const fromDisk = location.protocol === 'file:';
  if (fromDisk) window.Worker = undefined;
  window.addEventListener('load', fromDisk ? searchInPage : showAnswers);
})();
