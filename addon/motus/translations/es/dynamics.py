"""Spanish: dynamics."""

INTERFACE = {
    "Dynamics": "Dinámica",
    "Dynamics Presets": "Preajustes de dinámica",
    "Follow": "Seguir",
    "Which motion is followed": "Qué movimiento se sigue",
    "Own Animation": "Animación propia",
    "The thing's own location, rotation and scale, whatever its parents do":
        "La posición, rotación y escala propias, hagan lo que hagan sus padres",
    "World Motion": "Movimiento en el mundo",
    "Where it is carried in the world as well; a bone turns to where its tail has come":
        "También adonde es llevado en el mundo; un hueso se gira hacia donde ha llegado su cola",
    "Channels": "Canales",
    "What of it follows": "Qué parte sigue",
    "The location follows": "Sigue la posición",
    "The rotation follows": "Sigue la rotación",
    "The scale follows": "Sigue la escala",
    "Scale": "Escala",
    "How many times a second it swings. No keys: the whole motion follows from it":
        "Cuántas veces por segundo oscila. Sin claves: todo el movimiento depende de ello",
    "0 swings for ever, 1 comes to rest soonest without swinging. No keys: the whole motion follows from it":
        "Con 0 oscila para siempre, con 1 se detiene lo antes posible sin oscilar. Sin claves: todo el movimiento depende de ello",
    "0 starts slowly, 1 starts at once, above 1 it overshoots, below 0 it winds up first. No keys: the whole motion follows from it":
        "Con 0 arranca despacio, con 1 enseguida, por encima de 1 se pasa, por debajo de 0 toma impulso antes. Sin claves: todo el movimiento depende de ello",
    "Delay": "Retraso",
    "How much later it follows. No keys: the whole motion follows from it":
        "Cuánto más tarde sigue. Sin claves: todo el movimiento depende de ello",
    "Delay per Bone": "Retraso por hueso",
    "How much later each bone of a chain follows than the one above it":
        "Cuánto más tarde sigue cada hueso de una cadena que el que está por encima",
    "From the animation (0) to what follows it (1)": "De la animación (0) a lo que la sigue (1)",
    "Let the motion close without a seam over a range of frames. No keys: the whole motion follows from it":
        "Hace que el movimiento se cierre sin costura en un intervalo de fotogramas. Sin claves: todo el movimiento depende de ello",
    "First frame of the loop. No keys: the whole motion follows from it":
        "Primer fotograma del bucle. Sin claves: todo el movimiento depende de ello",
    "Frame on which the loop begins again, which looks like its first one. No keys: the whole motion follows from it":
        "Fotograma en el que el bucle vuelve a empezar, igual que el primero. Sin claves: todo el movimiento depende de ello",
    "Teleport": "Teletransporte",
    "What moves farther than this in a frame has jumped there, and starts anew at rest; 0 never does. No keys: the whole motion follows from it":
        "Lo que se mueve más que esto en un fotograma ha saltado allí, y empieza de nuevo en reposo; con 0 nunca. Sin claves: todo el movimiento depende de ello",
    "Bone that follows; empty is the object itself, or a property": "Hueso que sigue; vacío es el propio objeto o una propiedad",
    "Property": "Propiedad",
    "Path of a single property from the object that follows; empty is the object itself, or its bone":
        "Ruta desde el objeto de una sola propiedad que sigue; vacía es el propio objeto, o su hueso",
    "Which number of an array property; -1 is all of them":
        "Qué número de una propiedad múltiple; -1 son todos",
    "Only Active": "Solo la activa",
    "Take the entry that the object's list has marked, and no other one":
        "Toma la entrada marcada en la lista del objeto, y ninguna otra",
    "Topmost bone of the chain that it was added with": "Hueso superior de la cadena con la que se añadió",
    "Mass": "Masa",
    "What hangs on the spring": "Lo que cuelga del muelle",
    "What hangs on a spring, in place of frequency, damping and response":
        "Lo que cuelga de un muelle, en lugar de frecuencia, amortiguación y respuesta",
    "Style": "Estilo",
    "Frequency, damping and response that go by a name": "Frecuencia, amortiguación y respuesta con un nombre",
    "Frequency, damping and response that go by a name, in place of those that are given":
        "Frecuencia, amortiguación y respuesta con un nombre, en lugar de las que se dan",
    "Custom": "Personalizado",
    "Numbers of one's own": "Números propios",
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
    "In which numbers the motion is shown and set; it stays the same":
        "En qué números se muestra y se ajusta el movimiento, que sigue siendo el mismo",
    "By frequency, damping and response": "Por frecuencia, amortiguación y respuesta",
    "Overshoot": "Rebasamiento",
    "By how far it overshoots, and how long it takes to settle": "Por cuánto se pasa y cuánto tarda en asentarse",
    "Spring": "Muelle",
    "By a mass on a spring and a damper": "Por una masa en un muelle y un amortiguador",
    "How far it goes beyond a step, as a part of the step": "Cuánto va más allá de un escalón, como parte del escalón",
    "How far it goes beyond a step, as a part of the step: with Settling in place of frequency and damping":
        "Cuánto va más allá de un escalón, como parte del escalón: con el asentamiento, en lugar de frecuencia y amortiguación",
    "Settling": "Asentamiento",
    "How long it takes to come to rest": "Cuánto tarda en detenerse",
    "How long it takes to come to rest, to a fiftieth of a step":
        "Cuánto tarda en detenerse, hasta una quincuagésima parte de un escalón",
    "Stiffness": "Rigidez",
    "Of the spring, N/m": "Del muelle, N/m",
    "Resistance": "Resistencia",
    "Of the damper, N s/m": "Del amortiguador, N s/m",
    "Leave it to its animation": "Dejarlo a su animación",
    "How much all dynamics of the object act; 0 leaves it to its animation":
        "Cuánto actúa toda la dinámica del objeto; 0 lo deja a su animación",
    "Amount": "Cantidad",
    "Whole Chains": "Cadenas enteras",
    "Take all bones below along": "Incluir todos los huesos que están por debajo",
    "Let objects, bones or a property follow their animation with weight, swing and overshoot":
        "Hace que objetos, huesos o una propiedad sigan su animación con peso y oscilación",
    "Leave objects, bones or properties to their own animation again":
        "Devuelve objetos, huesos o propiedades a su propia animación",
    "Let the motion close without a seam over the scene's frames, where the animation does":
        "Hace que el movimiento se cierre sin costura en los fotogramas de la escena, si la animación lo hace",
    "Wire the object again, after its bones or parents were changed":
        "Vuelve a cablear el objeto después de cambiar sus huesos o padres",
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
    "{object} has dynamics": "{object} tiene dinámica",
    "{count} things have dynamics": "{count} elementos tienen dinámica",
    "What {bone} hangs on moves with it": "Aquello de lo que cuelga {bone} se mueve con él",
    "{object} is driven by {system} already: let a child of it follow":
        "{object} ya está controlado por {system}: haz que lo siga un hijo suyo",
    "{object} has these dynamics from its library, so that they cannot be removed here: mute them":
        "{object} tiene esta dinámica de su biblioteca, así que no se puede quitar aquí: silénciala",
    "Some of what is followed is not known ahead: record it": "Parte de lo que se sigue no se conoce de antemano: grábalo",
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
    "Some numbers are none that a motion can be made of": "Con algunos números no se puede hacer un movimiento",
    "Where the motion loops, jumps of what it follows are swung through":
        "Donde el movimiento se repite, los saltos de lo que sigue se recorren oscilando",
    "Constraints of its own are not followed, and may undo it: let an empty have them, and a child of that the dynamics":
        "Sus propias restricciones no se siguen y pueden anularlo: déjelas en un vacío, y la dinámica en un hijo de este",
    "Some bones move with what they follow, and are left out": "Algunos huesos se mueven con lo que siguen y quedan fuera",
    "Hopping Creature": "Criatura saltarina",
    "A creature whose body, tail and antennae swing along with the few keys that make it hop":
        "Una criatura cuyo cuerpo, cola y antenas oscilan con las pocas claves que la hacen saltar",
}

OPERATORS = {
    "Add Dynamics": "Añadir dinámica",
    "Add to Whole Chains": "Añadir a cadenas enteras",
    "Use Dynamics Preset": "Usar preajuste de dinámica",
    "Add Dynamics Preset": "Añadir preajuste de dinámica",
    "Loop over the Scene": "Bucle de la escena",
    "Remove Dynamics": "Quitar dinámica",
}
