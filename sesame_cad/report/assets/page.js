// Brings the page to life. `sesameReport` is for whoever looks at it from the console.
const read = (id) => JSON.parse(document.getElementById(id).textContent);

function themeButton() {
  const root = document.documentElement, button = document.getElementById('theme');
  button.addEventListener('click', () => {
    const dark = root.dataset.theme ? root.dataset.theme === 'dark' : matchMedia('(prefers-color-scheme: dark)').matches;
    root.dataset.theme = dark ? 'light' : 'dark';
  });
}

function start() {
  const made = {};
  themeButton();
  document.documentElement.classList.add('alive');
  const shape = document.getElementById('shape-data');
  if (shape) {
    const root = document.getElementById('viewer');
    try {
      made.viewer = new Viewer(root, JSON.parse(shape.textContent), read('colours'));
    } catch (fault) {
      root.classList.add('blind');
      root.querySelector('.blind-note').append(` (${fault.message})`);
    }
  }
  made.players = [...document.querySelectorAll('.player')].map((root) => new Player(root, read(root.dataset.stitches)));
  [made.player] = made.players;
  return made;
}

// first the page itself, then what takes longer
requestAnimationFrame(() => setTimeout(() => {
  window.sesameReport = start();
  document.documentElement.classList.add('ready');
}));
