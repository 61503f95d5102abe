// The chosen theme is set before the page is painted; without a choice the system decides.
// This is a classic script on purpose: a module would run after the first paint.
{
  let chosen = null;
  try {
    chosen = localStorage.getItem("stonepass-theme");
  } catch {
    // Storage may be forbidden; the theme of the system is used then.
  }
  if (chosen === "dark" || chosen === "light") document.documentElement.dataset.theme = chosen;
}
