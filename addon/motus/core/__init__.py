"""Code that all systems (features such as Follow Path or Pendulums) share. It never imports a system."""
