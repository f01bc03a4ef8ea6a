const ARROWS = ['ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'Home', 'End'];

/** Whether the focused control has its own use for the key. */
function ownUse(target, key) {
  if (target.matches?.('select, textarea, input[type=search], input[type=text]')) return true;
  if (target.matches?.('button')) return key === ' ';
  if (target.matches?.('input[type=radio]')) return ARROWS.includes(key);
  if (target.matches?.('input[type=range]')) return ARROWS.includes(key) && target.getAttribute('aria-label') !== 'Time';
  return false;
}

/** Keys act on the view shown; F resets the camera. */
export function bindKeys(current, reset) {
  window.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || ownUse(event.target, event.key)) return;
    if (event.key === 'f' || event.key === 'F') reset();
    else if (!current()?.key(event)) return;
    event.preventDefault();
  });
}
