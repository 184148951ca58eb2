"""Spanish: dynamics."""

INTERFACE = {
    "Dynamics on {name}": "Dinámica en {name}",
    "Dynamics on {count} Bones": "Dinámica en {count} huesos",
    "Dynamics on {count} Objects": "Dinámica en {count} objetos",
    "Dynamics": "Dinámica",
    "Dynamics Presets": "Preajustes de dinámica",
    "Follow": "Seguir",
    "Motion that the dynamics follow": "Movimiento que sigue la dinámica",
    "The object's or bone's own location, rotation and scale; the motion of parents does not count":
        "La posición, rotación y escala propias del objeto o hueso; el movimiento de sus padres no cuenta",
    "The motion in the world, that of parents included; a bone turns to where its tail has come":
        "El movimiento en el mundo, incluido el de los padres; un hueso se gira hacia donde ha llegado su cola",
    "Channels": "Canales",
    "Channels that the dynamics act on": "Canales sobre los que actúa la dinámica",
    "The location follows": "Sigue la posición",
    "The rotation follows": "Sigue la rotación",
    "The scale follows": "Sigue la escala",
    "Scale": "Escala",
    "Swings per second. Cannot be keyed: the whole motion follows from it":
        "Oscilaciones por segundo. No admite claves: todo el movimiento depende de ello",
    "0 swings for ever, 1 comes to rest soonest without swinging. Cannot be keyed: the whole motion follows from it":
        "Con 0 oscila para siempre, con 1 se detiene lo antes posible sin oscilar. No admite claves: todo el movimiento depende de ello",
    "0 starts slowly, 1 starts at once, above 1 it overshoots, below 0 it winds up first. Cannot be keyed: the whole motion follows from it":
        "Con 0 arranca despacio, con 1 enseguida, por encima de 1 se pasa, por debajo de 0 toma impulso antes. No admite claves: todo el movimiento depende de ello",
    "Delay": "Retraso",
    "Time by which the motion follows later. Cannot be keyed: the whole motion follows from it":
        "Tiempo que tarda más en seguir el movimiento. No admite claves: todo el movimiento depende de ello",
    "Delay per Bone": "Retraso por hueso",
    "Time by which each bone of a chain follows later than its parent":
        "Tiempo que cada hueso de una cadena sigue más tarde que su padre",
    "Blend from the animation (0) to the dynamics (1)": "Mezcla de la animación (0) a la dinámica (1)",
    "Let the motion close without a seam over a range of frames. Cannot be keyed: the whole motion follows from it":
        "Hace que el movimiento se cierre sin costura en un intervalo de fotogramas. No admite claves: todo el movimiento depende de ello",
    "First frame of the loop. Cannot be keyed: the whole motion follows from it":
        "Primer fotograma del bucle. No admite claves: todo el movimiento depende de ello",
    "Frame on which the loop begins again, which looks like its first one. Cannot be keyed: the whole motion follows from it":
        "Fotograma en el que el bucle vuelve a empezar, igual que el primero. No admite claves: todo el movimiento depende de ello",
    "Teleport": "Teletransporte",
    "A motion of more than this in a frame is a jump, after which the dynamics start anew at rest; 0 for none. Cannot be keyed: the whole motion follows from it":
        "Un movimiento mayor que esto en un fotograma es un salto, tras el que la dinámica empieza de nuevo en reposo; 0 para ninguno. No admite claves: todo el movimiento depende de ello",
    "Bone that has the dynamics; empty for the object itself, or a property":
        "Hueso que tiene la dinámica; vacío para el propio objeto, o una propiedad",
    "Property": "Propiedad",
    "Data path of the property that has the dynamics; empty for the object itself, or its bone":
        "Ruta de datos de la propiedad que tiene la dinámica; vacía para el propio objeto, o su hueso",
    "Index of a number in an array property; -1 for all of them":
        "Índice de un número en una propiedad múltiple; -1 para todos",
    "Only Active": "Solo la activa",
    "Act on the active entry of the list alone": "Actuar solo sobre la entrada activa de la lista",
    "Topmost bone of the chain that it was added with": "Hueso superior de la cadena con la que se agregó",
    "Mass": "Masa",
    "Mass that hangs on the spring": "Masa que cuelga del muelle",
    "Mass that hangs on a spring, in place of frequency, damping and response":
        "Masa que cuelga de un muelle, en lugar de frecuencia, amortiguación y respuesta",
    "Style": "Estilo",
    "Named set of frequency, damping and response": "Conjunto con nombre de frecuencia, amortiguación y respuesta",
    "Named set of frequency, damping and response, in place of those that are given":
        "Conjunto con nombre de frecuencia, amortiguación y respuesta, en lugar de las que se dan",
    "Custom": "Personalizado",
    "Numbers that no style has": "Números que no son de ningún estilo",
    "Critical": "Crítico",
    "Follows smoothly and never overshoots": "Sigue con suavidad y nunca se pasa",
    "Bouncy": "Saltarín",
    "Overshoots, and swings some times before it rests": "Se pasa y oscila algunas veces antes de detenerse",
    "Jelly": "Gelatina",
    "Trembles for long": "Tiembla mucho tiempo",
    "Sluggish": "Pesado",
    "Is slow to start and slow to stop": "Tarda en arrancar y en detenerse",
    "Snappy": "Vivo",
    "Is there at once, with a short overshoot": "Llega enseguida y se pasa un poco",
    "Anticipating": "Con anticipación",
    "Winds up to the other side before it starts": "Toma impulso hacia el otro lado antes de arrancar",
    "Floppy": "Colgante",
    "Trails behind and swings wide: tails, hair, antennae": "Se queda atrás y oscila mucho: colas, pelo, antenas",
    "Smooth": "Suave",
    "Takes the jerks out of a motion": "Quita las sacudidas a un movimiento",
    "Set By": "Ajustar por",
    "Numbers by which the motion is shown and set; the motion stays the same":
        "Números con los que se muestra y se ajusta el movimiento, que sigue siendo el mismo",
    "Set frequency, damping and response": "Ajustar frecuencia, amortiguación y respuesta",
    "Overshoot": "Rebasamiento",
    "Set how far the motion overshoots, and how long it takes to settle":
        "Ajustar cuánto se pasa el movimiento y cuánto tarda en asentarse",
    "Spring": "Muelle",
    "Set a mass on a spring and a damper": "Ajustar una masa en un muelle y un amortiguador",
    "How far the motion goes beyond a step, as a part of the step":
        "Cuánto va el movimiento más allá de un escalón, como parte del escalón",
    "How far the motion goes beyond a step, as a part of the step; with Settling in place of frequency and damping":
        "Cuánto va el movimiento más allá de un escalón, como parte del escalón; con Asentamiento, en lugar de frecuencia y amortiguación",
    "Settling": "Asentamiento",
    "Time until the motion comes to rest": "Tiempo hasta que el movimiento se detiene",
    "Time until the motion stays within a fiftieth of a step":
        "Tiempo hasta que el movimiento queda a menos de una quincuagésima parte de un escalón",
    "Stiffness": "Rigidez",
    "Stiffness of the spring, in N/m": "Rigidez del muelle, en N/m",
    "Resistance": "Resistencia",
    "Damping of the damper, in N·s/m": "Amortiguación del amortiguador, en N·s/m",
    "Switch the dynamics of this entry off": "Desactivar la dinámica de esta entrada",
    "How much all dynamics of the object act; 0 leaves the object to its animation":
        "Cuánto actúa toda la dinámica del objeto; 0 deja el objeto a su animación",
    "Amount": "Cantidad",
    "Whole Chains": "Cadenas enteras",
    "Add dynamics to all bones below the selected ones too":
        "Agregar dinámica también a todos los huesos bajo los seleccionados",
    "Let objects, bones or a property follow their animation with weight, swing and overshoot":
        "Hace que objetos, huesos o una propiedad sigan su animación con peso y oscilación",
    "Remove dynamics from objects, bones or properties": "Quitar la dinámica de objetos, huesos o propiedades",
    "Let the motion close without a seam over the scene's frames, where the animation does":
        "Hace que el movimiento se cierre sin costura en los fotogramas de la escena, si la animación lo hace",
    "Name of the object; empty takes the selected ones, in Pose Mode the selected bones":
        "Nombre del objeto; vacío toma los seleccionados, en modo Pose los huesos seleccionados",
    "Names of bones of the object, with commas between": "Nombres de huesos del objeto, separados por comas",
    "Names of bones of the object, with commas between; empty takes all that follows":
        "Nombres de huesos del objeto, separados por comas; vacío toma todo lo que sigue",
    "Path from the object of a single property, which follows in place of the object":
        "Ruta desde el objeto de una sola propiedad, que sigue en lugar del objeto",
    "Index of a number in an array property; -1 for all of it": "Índice de un número en una propiedad múltiple; -1 para toda ella",
    "Input": "Entrada",
    "Nothing moves here yet that could be followed": "Aquí aún no se mueve nada que se pueda seguir",
    "Exact at any frame": "Exacto en cualquier fotograma",
    "A sudden move, over {seconds} s": "Un movimiento repentino, durante {seconds} s",
    "Nothing here has dynamics": "Nada tiene dinámica aquí",
    "Select the bones that shall follow": "Selecciona los huesos que deben seguir",
    "Select what shall follow": "Selecciona lo que debe seguir",
    "Dynamics added to {object}": "Dinámica agregada a {object}",
    "Dynamics added to {count} bones": "Dinámica agregada a {count} huesos",
    "Dynamics added to {count} objects": "Dinámica agregada a {count} objetos",
    "What {bone} hangs on moves with it": "Aquello de lo que cuelga {bone} se mueve con él",
    "{object} is driven by {system} already: let a child of it follow":
        "{object} ya está controlado por {system}: haz que lo siga un hijo suyo",
    "{object} has these dynamics from its library, so that they cannot be removed here: mute them":
        "{object} tiene esta dinámica de su biblioteca, así que no se puede quitar aquí: silénciala",
    "Some of the followed motion cannot be read from keys: record it":
        "Parte del movimiento seguido no se puede leer de las claves: grábalo",
    "A rotation does not come back to where its loop began": "Una rotación no vuelve adonde empezó su bucle",
    "Some of what is followed is not known on other frames, and cannot be recorded":
        "Parte de lo que se sigue no se conoce en otros fotogramas y no se puede grabar",
    "What {thing} follows needs recording: {reason}": "Lo que sigue {thing} necesita grabarse: {reason}",
    "What {thing} follows is not known on other frames: {reason}":
        "Lo que sigue {thing} no se conoce en otros fotogramas: {reason}",
    "A loop ends before it begins, and is none: set its end behind its start":
        "Un bucle termina antes de empezar y no lo es: pon su final después de su inicio",
    "The loop ends on frame {end}, before it begins on frame {start}":
        "El bucle termina en el fotograma {end}, antes de empezar en el {start}",
    "Some bones that follow are not there any more: remove them from the list":
        "Algunos huesos que siguen ya no existen: quítalos de la lista",
    "{object} has no bone {bone}: remove it from the list": "{object} no tiene el hueso {bone}: quítalo de la lista",
    "No bone is named: give names with commas between":
        "No se nombra ningún hueso: da sus nombres, separados por comas",
    "{path} is a setting of the dynamics themselves": "{path} es un ajuste de la propia dinámica",
    "Only the first {count} numbers of an array can follow: give an index below that":
        "Solo pueden seguir los primeros {count} números de una propiedad múltiple: da un índice menor",
    "{first} and {second} say the same in two ways: give one of them":
        "{first} y {second} dicen lo mismo de dos maneras: da una de ellas",
    "{name} does not go with a single property": "{name} no va con una sola propiedad",
    "Some numbers are outside of what a motion can be computed from":
        "Algunos números están fuera de lo que permite calcular un movimiento",
    "What is followed goes on for too long, and only its beginning counts: raise Damping or Frequency, shorten Delay, or have fewer dynamics":
        "Lo que se sigue dura demasiado y solo cuenta su principio: sube Amortiguación o Frecuencia, acorta Retraso, o usa menos dinámica",
    "Where the motion loops, jumps of what it follows are swung through":
        "Donde el movimiento se repite, los saltos de lo que sigue se recorren oscilando",
    "Constraints of its own are not followed, and may undo it: let an empty have them, and a child of that the dynamics":
        "Sus propias restricciones no se siguen y pueden anularlo: déjalas en un vacío, y la dinámica en un hijo de este",
    "Some bones move with what they follow, and are left out": "Algunos huesos se mueven con lo que siguen y quedan fuera",
    "Hopping Creature": "Criatura saltarina",
    "A creature whose body, tail and antennae swing along with the few keys that make it hop":
        "Una criatura cuyo cuerpo, cola y antenas oscilan con las pocas claves que la hacen saltar",
}

OPERATORS = {
    "Add Dynamics": "Agregar dinámica",
    "Dynamics of Whole Chains": "Agregar dinámica a cadenas enteras",
    "Use Dynamics Preset": "Usar preajuste de dinámica",
    "Add Dynamics Preset": "Agregar preajuste de dinámica",
    "Loop over the Scene": "Bucle de la escena",
    "Remove Dynamics": "Quitar dinámica",
}
