import './style.css';
import { App } from './app';
import { loadEngine } from './engine';
import { embeddedFiles } from './files';
import { documentDrop } from './run';
import { decode } from './share';

// The order: a run inside the page, one in the address, the document's drop.
async function begin(): Promise<App> {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const follow = (): void => {
    document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
  };
  follow();
  dark.addEventListener('change', follow);
  const app = new App(await loadEngine());
  const fromAddress = async (): Promise<void> => {
    try {
      app.open(await decode(location.hash));
      if (location.hash) (document.getElementById('scene') as HTMLSelectElement).value = location.hash.includes('scene=') ? '' : 'drop';
    } catch (error) {
      app.open({ a: documentDrop, b: null, time: 0 });
      app.tell((error as Error).message, true);
    }
  };
  const files = await embeddedFiles();
  if (files.length > 0 && !location.hash) app.openTexts(files);
  else await fromAddress();
  window.addEventListener('hashchange', () => void fromAddress());
  if (!location.hash) app.welcome();
  return app;
}

begin().then(
  // For those who want the numbers: in the console, and in the tests.
  (app) => Object.assign(window, { tumble: app }),
  (error: Error) => {
    const message = document.getElementById('message') as HTMLElement;
    message.hidden = false;
    message.classList.add('is-error');
    message.textContent = `The page could not start: ${error.message}`;
  },
);
