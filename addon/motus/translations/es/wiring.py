"""Spanish: wiring and demos."""

INTERFACE = {
    "Hidden object that computes for this one": "Objeto oculto que calcula para este",
    "More Hubs": "Más núcleos",
    "Hubs of the groups but the first, by the groups' keys": "Núcleos de los grupos menos el primero, por las claves de los grupos",
    "Row": "Fila",
    "Which of the objects that share the hub this one is": "Cuál de los objetos que comparten el núcleo es este",
    "Targets": "Objetivos",
    "Hidden objects that the constraints have as targets": "Objetos ocultos que las restricciones tienen como objetivos",
    "Keyframes cannot undo the stretch that these bones inherit from the chain: {bones}": "Los fotogramas clave no pueden deshacer el estiramiento que estos huesos heredan de la cadena: {bones}",
    "{path} of {object} is no decimal number": "{path} de {object} no es un número decimal",
    "{path} of {object} has a driver already: remove it first": "{path} de {object} ya tiene un controlador: quítalo antes",
    "A property that is to be driven is gone, has another driver, or is another file's; what is left is driven": "Una propiedad que se ha de controlar ya no está, tiene otro controlador o es de otro archivo; las demás se controlan",
    "A setting, or what comes of it, is no number, or too large: look through the settings": "Un ajuste, o lo que resulta de él, no es un número, o es demasiado grande: revisa los ajustes",
    "Wired": "Conectado",
    "What was wired, to notice where it has changed since": "Lo que se conectó, para notar dónde ha cambiado desde entonces",
    "Reaching Pilot": "Piloto que alcanza",
    "A wooden figure whose hand and eyes follow a butterfly, while its feet and other hand stay put, and a daisy that stretches toward it": "Una figura de madera cuya mano y cuyos ojos siguen a una mariposa, mientras los pies y la otra mano no se mueven, y una margarita que se estira hacia ella",
}

OPERATORS = {}
