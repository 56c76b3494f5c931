/** Lengths that a scale bar shows. */

const NICE = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100];  // lengths of a scale bar [mm]
/** The longest bar that takes at most `room` pixels. @param {number} perPixel [mm] */
export const barLength = (perPixel, room) => NICE.filter((mm) => mm / perPixel <= room).at(-1) ?? NICE[0];

/** Fits a bar over a 3D view to its zoom. @param {HTMLElement} element with a child for the text @param stage */
export function drawScaleBar(element, stage) {
  const perPixel = stage.view.perPixel(stage.canvas.clientHeight);
  const mm = barLength(perPixel, 110);
  element.style.width = `${mm / perPixel}px`;
  element.firstElementChild.textContent = `${mm} mm`;
}
