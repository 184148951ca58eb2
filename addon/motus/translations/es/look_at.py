"""Spanish: look at."""

INTERFACE = {
    "Person": "Persona",
    "Eyes first, then the head, and a little of the back":
        "Primero los ojos, luego la cabeza y un poco la espalda",
    "Glance": "Vistazo",
    "The eyes nearly alone": "Casi solo los ojos",
    "Owl": "Búho",
    "The head alone, nearly all the way round": "Solo la cabeza, casi la vuelta entera",
    "Snake": "Serpiente",
    "The whole body turns along": "Gira con todo el cuerpo",
    "Look At Presets": "Preajustes de mirar a",
    "Automatic": "Automático",
    "Where the rig faces at rest, by Forward; an eye that points there looks along its bone":
        "Hacia donde mira el rig en reposo, según Adelante; un ojo que apunta hacia allí mira a lo largo de su hueso",
    "Axis of the rig that points where the character faces at rest":
        "Eje del rig que apunta hacia donde mira el personaje en reposo",
    "Axis of the rig that points where the character faces at rest; not given, eyes, face, feet and sides of the skeleton show it":
        "Eje del rig que apunta hacia donde mira el personaje en reposo; si no se indica, lo muestran los ojos, la cara, los pies y los lados del esqueleto",
    "Axis of the rig that points from the feet to the head at rest":
        "Eje del rig que apunta de los pies a la cabeza en reposo",
    "Axis of the rig that points from the feet to the head at rest; not given, the skeleton shows it":
        "Eje del rig que apunta de los pies a la cabeza en reposo; si no se indica, lo muestra el esqueleto",
    "Turn the direction in which the character faces at rest by a quarter, about Up; a new target goes along":
        "Girar un cuarto de vuelta, en torno a Arriba, la dirección hacia la que mira el personaje en reposo; un objetivo nuevo va con ella",
    "{bone} of {object} faces {axis}": "{bone} de {object} mira hacia {axis}",
    "Facing": "Orientación",
    "Weight": "Peso",
    "How much eyes, head and body turn to the target; 0 leaves the animation as it is":
        "Cuánto giran ojos, cabeza y cuerpo hacia el objetivo; 0 deja la animación como está",
    "Body": "Cuerpo",
    "Share of the turn that the spine takes, spread over its bones":
        "Parte del giro que toma la columna, repartida entre sus huesos",
    "Head": "Cabeza",
    "Share of what the body leaves that the head takes": "Parte que toma la cabeza de lo que deja el cuerpo",
    "Eyes": "Ojos",
    "Share of what the head leaves that the eyes take": "Parte que toman los ojos de lo que deja la cabeza",
    "Clamp": "Contención",
    "How much the whole turn is held back: 0 lets it go all around, 0.5 to the side, 1 not at all":
        "Cuánto se contiene el giro entero: 0 lo deja dar toda la vuelta, 0,5 hasta el lado, 1 nada",
    "Body Limit": "Límite del cuerpo",
    "Largest turn of all spine bones together": "Giro máximo de todos los huesos de la columna juntos",
    "Head Limit": "Límite de la cabeza",
    "Largest turn of the head against the spine": "Giro máximo de la cabeza respecto a la columna",
    "Eyes Limit": "Límite de los ojos",
    "Largest turn of the eyes against the head": "Giro máximo de los ojos respecto a la cabeza",
    "Head Forward": "Frente de la cabeza",
    "Axis of the head bone that points where the face looks":
        "Eje del hueso de la cabeza que apunta hacia donde mira la cara",
    "Eyes Forward": "Frente de los ojos",
    "Axis of the eye bones that points where they look": "Eje de los huesos de los ojos que apunta hacia donde miran",
    "Eye": "Ojo",
    "Heads": "Cabezas",
    "Names of several head bones, with commas between: all are added at once":
        "Nombres de varios huesos de cabezas, separados por comas: se agregan todas a la vez",
    "Look At with {bone}": "Mirar con {bone}",
    "Look At with {count} Bones": "Mirar con {count} huesos",
    "{bone} Looks at {target}": "{bone} mira a {target}",
    "Bone of the eye, below the head": "Hueso del ojo, bajo la cabeza",
    "Bone of the head": "Hueso de la cabeza",
    "Object to look at": "Objeto que se mira",
    "Bone of the target to look at; empty takes its origin": "Hueso del objetivo que se mira; vacío toma su origen",
    "Spine Bones": "Huesos de la columna",
    "How many bones below the head turn along, the neck among them":
        "Cuántos huesos bajo la cabeza giran con ella, el cuello incluido",
    "Switch the entry off: the head keeps its own animation":
        "Desactivar la entrada: la cabeza conserva su propia animación",
    "How much all heads of the rig turn to their targets; 0 leaves the rig to its animation":
        "Cuánto giran todas las cabezas del rig hacia sus objetivos; 0 deja el rig a su animación",
    "Entries": "Entradas",
    "Active Entry": "Entrada activa",
    "Bones": "Huesos",
    "Target Left": "A la izquierda",
    "Target Right": "A la derecha",
    "Target Up": "Por encima",
    "Target Down": "Por debajo",
    "Still to Turn": "Falta girar",
    "Let head, spine and eyes turn to a target": "Hacer que cabeza, columna y ojos se vuelvan hacia un objetivo",
    "Remove Look At, so that the head has its own animation again; a target that was made goes along if nothing else needs it":
        "Quitar Mirar a, de modo que la cabeza vuelve a su propia animación; un objetivo que se creó se va con él si nada más lo necesita",
    "Let another bone below the head turn as an eye": "Hacer que otro hueso bajo la cabeza gire como un ojo",
    "Leave an eye to its own animation again": "Dejar otra vez un ojo a su propia animación",
    "Name of the head bone; empty takes the active one, or the one that is called head":
        "Nombre del hueso de la cabeza; vacío toma el activo, o el que se llama head",
    "Name of the head bone; empty takes the active one": "Nombre del hueso de la cabeza; vacío toma el activo",
    "Name of the object to look at; empty makes one in front of the head":
        "Nombre del objeto que se mira; vacío crea uno delante de la cabeza",
    "Name of the target's bone to look at, where the target is an armature":
        "Nombre del hueso del objetivo que se mira, cuando el objetivo es un esqueleto",
    "How many bones below the head turn along, the neck among them; -1 finds the spine":
        "Cuántos huesos bajo la cabeza giran con ella, el cuello incluido; -1 busca la columna",
    "Names of the eye bones with commas between; not given, bones below the head called eye":
        "Nombres de los huesos de los ojos separados por comas; si no se indican, los huesos bajo la cabeza llamados eye",
    "Name of the eye bone; empty takes the selected bones below the head":
        "Nombre del hueso del ojo; vacío toma los huesos seleccionados bajo la cabeza",
    "Name of the eye bone": "Nombre del hueso del ojo",
    "{head} of {object} looks at {target}": "{head} de {object} mira a {target}",
    "{bone} of {object} looks at nothing": "{bone} de {object} no mira a nada",
    "Nothing here looks at a target": "Aquí nada mira a un objetivo",
    "Select the armature whose head shall look": "Selecciona el esqueleto cuya cabeza ha de mirar",
    "Choose the bone of the head": "Elige el hueso de la cabeza",
    "Name an armature as the target of a bone": "Indica un esqueleto como objetivo de un hueso",
    "An eye is named twice": "Un ojo se nombra dos veces",
    "{bone} is not below {head}": "{bone} no está bajo {head}",
    "{bone} is below another eye": "{bone} está bajo otro ojo",
    "{bone} is no eye of {head}": "{bone} no es un ojo de {head}",
    "There are only {count} bones below {head}": "Solo hay {count} huesos bajo {head}",
    "Select the bones of the eyes in Pose Mode": "Selecciona los huesos de los ojos en el modo Pose",
    "{bone} is driven by {system} of {other} already": "{bone} ya está movido por {system} de {other}",
    "{bone} is turned by another head already: take fewer spine bones":
        "Otra cabeza ya gira {bone}: toma menos huesos de la columna",
    "{target} moves with {head}, so {head} cannot look at it":
        "{target} se mueve con {head}, así que {head} no puede mirarlo",
    "Some heads have nothing to look at: the list says why":
        "Algunas cabezas no tienen nada que mirar: la lista dice por qué",
    "The target moves with the head that looks at it: choose another one":
        "El objetivo se mueve con la cabeza que lo mira: elige otro",
    "Choose a target to look at": "Elige un objetivo que mirar",
    "The target is in no collection any more: choose another one":
        "El objetivo ya no está en ninguna colección: elige otro",
    "The target has no bone of this name": "El objetivo no tiene ningún hueso con este nombre",
    "The target is {degrees} degrees beyond the limits": "El objetivo está {degrees} grados más allá de los límites",
    "The weights leave {degrees} degrees to the target": "Los pesos dejan {degrees} grados hasta el objetivo",
}

OPERATORS = {
    "Use Look At Preset": "Usar preajuste de mirar a",
    "Add Look At Preset": "Agregar preajuste de mirar a",
    "Look At": "Mirar a",
    "Remove Look At": "Quitar mirar a",
    "Turn Forward": "Girar Adelante",
    "Add Eye": "Agregar ojo",
    "Remove Eye": "Quitar ojo",
}
