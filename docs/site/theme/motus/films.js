// Moving pictures are loaded and played while they are seen, and not for readers who prefer less motion.
"use strict";

{
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const seen = new IntersectionObserver((entries) => {
    for (const { target, isIntersecting } of entries) {
      if (!isIntersecting || calm.matches) {
        target.pause();
        continue;
      }
      target.src ||= target.dataset.film;
      target.play().catch(() => {}); // where a browser saves power the still stays
    }
  }, { threshold: 0.4 });
  for (const film of document.querySelectorAll(".motus-film")) seen.observe(film);
}
