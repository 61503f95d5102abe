// What has to be known before the page is painted: its theme, and its font.
// This is a classic script on purpose: a module would run after the first paint.
{
  const root = document.documentElement;

  // Without a choice, the system decides about the theme.
  let chosen = null;
  try {
    chosen = localStorage.getItem("stonepass-theme");
  } catch {
    // Storage may be forbidden; the theme of the system is used then.
  }
  if (chosen === "dark" || chosen === "light") root.dataset.theme = chosen;

  // Text in another font has other widths, so that the page would move when its font arrives.
  // Therefore nothing is shown before, for as long as browsers wait for a font (3 s).
  const shown = () => delete root.dataset.waiting;
  root.dataset.waiting = "";
  document.fonts.load("1rem Inter").then(shown, shown);
  setTimeout(shown, 3000);
}
