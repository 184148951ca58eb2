"""Spanish: pendulums."""

INTERFACE = {
    "Wild": "Salvaje",
    "Tumbles over itself, and no two swings are alike": "Da vueltas sobre sí mismo y no hay dos oscilaciones iguales",
    "Clock": "Reloj",
    "Beats a second to each side": "Un segundo a cada lado",
    "Hanging Lamp": "Lámpara colgante",
    "Swings out and comes to rest": "Se balancea hasta quedar quieta",
    "Wrecking Ball": "Bola de demolición",
    "A heavy ball on a long arm": "Una bola pesada en un brazo largo",
    "On the Moon": "En la Luna",
    "A sixth of the weight": "Un sexto del peso",
    "A copy of a rod, or one without its pivot: it hangs on another pendulum":
        "Una copia de una varilla, o una sin su pivote: depende de otro péndulo",
    "A fan has 1 to 500 pendulums": "Un abanico tiene de 1 a 500 péndulos",
    "A fan has 1 to {count} pendulums": "Un abanico tiene de 1 a {count} péndulos",
    "A fan, beside it one pendulum alone, and a third one with quite other angles":
        "Un abanico, a su lado un péndulo solo, y un tercero con ángulos muy distintos",
    "A length, mass, angle, velocity, gravity or damping is too large or too small for the motion to be computed":
        "Una longitud, masa, ángulo, velocidad, gravedad o amortiguación es demasiado grande o pequeña para calcular el movimiento",
    "A pendulum has one bob or two beside its pivot: select or name those":
        "Un péndulo tiene una o dos lentejas además de su pivote: selecciónalas o nómbralas",
    "A second rod hangs on the first one's bob": "Una segunda varilla cuelga de la lenteja de la primera",
    "Acceleration Limit": "Límite de aceleración",
    "Acceleration by gravity along the pivot's -Z axis. Cannot be keyed: the whole motion follows from it":
        "Aceleración de la gravedad según el eje -Z del pivote. No admite claves: todo el movimiento depende de ello",
    "Active Object": "Objeto activo",
    "Alone": "Solo",
    "A single pendulum has one placed bob, a double one two, and a fan none":
        "Un péndulo simple tiene una lenteja colocada, uno doble dos, y un abanico ninguna",
    "An empty at the 3D cursor": "Un vacío en el cursor 3D",
    "Angle Step": "Paso de ángulo",
    "Before": "Antes",
    "Bob": "Lenteja",
    "Bob Radius": "Radio de lenteja",
    "Bobs": "Lentejas",
    "Difference of the lower angle from one pendulum of the fan to the next. Cannot be keyed: the whole motion follows from it":
        "Diferencia del ángulo inferior de un péndulo del abanico al siguiente. No admite claves: todo el movimiento depende de ello",
    "Angular velocity of the lower rod when the motion starts, per second. Cannot be keyed: the whole motion follows from it":
        "Velocidad angular de la varilla inferior al empezar el movimiento, por segundo. No admite claves: todo el movimiento depende de ello",
    "Angular velocity of the upper rod when the motion starts, per second. Cannot be keyed: the whole motion follows from it":
        "Velocidad angular de la varilla superior al empezar el movimiento, por segundo. No admite claves: todo el movimiento depende de ello",
    "Count": "Número",
    "Demonstration": "Demostración",
    "Double": "Doble",
    "Double pendulums whose lower angles differ a little from one to the next":
        "Péndulos dobles cuyos ángulos inferiores difieren un poco de uno al siguiente",
    "Driven Pivot": "Pivote impulsor",
    "Fan": "Abanico",
    "Forces": "Fuerzas",
    "Frame at which the motion starts; before it the pendulum waits. Cannot be keyed: the whole motion follows from it":
        "Fotograma en que empieza el movimiento; antes el péndulo espera. No admite claves: todo el movimiento depende de ello",
    "Distance from one pendulum of the fan to the next, across the plane of the swing":
        "Distancia de un péndulo del abanico al siguiente, a través del plano de la oscilación",
    "Hang a pendulum, a double pendulum or a fan of them on a pivot":
        "Cuelga de un pivote un péndulo, un péndulo doble o un abanico de ellos",
    "How many pendulums swing about the pivot": "Cuántos péndulos oscilan alrededor del pivote",
    "How many pendulums the fan has": "Cuántos péndulos tiene el abanico",
    "Number of rods of each pendulum": "Número de varillas de cada péndulo",
    "How much the pendulum turns its rods; 0 lets them hang as they are placed":
        "Cuánto gira el péndulo sus varillas; con 0 cuelgan como están puestas",
    "Hue": "Tono",
    "Keep Objects": "Conservar objetos",
    "Keep the pivot, rods and bobs that were made, at rest":
        "Conserva el pivote, las varillas y las lentejas que se crearon, en reposo",
    "Keep velocities and accelerations below limits that no real pendulum has. Cannot be keyed: the whole motion follows from it":
        "Mantiene velocidades y aceleraciones bajo límites que ningún péndulo real tiene. No admite claves: todo el movimiento depende de ello",
    "Key on the present frame whether the pendulum's time runs":
        "Pone en el fotograma actual una clave que dice si el tiempo del péndulo corre",
    "Largest change of the angular velocity, per second. Cannot be keyed: the whole motion follows from it":
        "Mayor cambio de la velocidad angular, por segundo. No admite claves: todo el movimiento depende de ello",
    "Largest angular velocity, per second. Cannot be keyed: the whole motion follows from it":
        "Mayor velocidad angular, por segundo. No admite claves: todo el movimiento depende de ello",
    "Let the pivot's own motion swing the pendulum, rather than carry it along alone. Cannot be keyed: the whole motion follows from it":
        "Deja que el movimiento del pivote impulse el péndulo, en vez de solo llevarlo consigo. No admite claves: todo el movimiento depende de ello",
    "Let the time run from here on": "El tiempo corre desde aquí",
    "Let the time stand still from here on": "El tiempo se detiene desde aquí",
    "Look": "Aspecto",
    "Made": "Creado",
    "Mass": "Masa",
    "Motus has made the pivot, and removes it with the pendulum":
        "Motus ha creado el pivote, y lo quita con el péndulo",
    "Name of the object that is the pivot; empty goes by what is chosen as the pivot":
        "Nombre del objeto que es el pivote; vacío atiende a lo elegido como pivote",
    "Name of the pivot, or of a rod or bob; empty takes the active one":
        "Nombre del pivote, o de una varilla o lenteja; vacío toma el activo",
    "Name of the pivot, or of a rod or bob; empty takes the selected ones":
        "Nombre del pivote, o de una varilla o lenteja; vacío toma los seleccionados",
    "Names, with commas between, of one or two objects that are the bobs, from the pivot on":
        "Nombres, separados por comas, de uno o dos objetos que son las lentejas, desde el pivote",
    "New Pivot": "Pivote nuevo",
    "Nothing here is part of a pendulum": "Nada aquí es parte de un péndulo",
    "Radius of a bob of 1 kg; heavier bobs are larger": "Radio de una lenteja de 1 kg; las más pesadas son mayores",
    "Location of a new pivot; that of the 3D cursor if it is not given":
        "Posición de un pivote nuevo; la del cursor 3D si no se indica",
    "Hue of the first pendulum; the hues of a fan go once around":
        "Tono del primer péndulo; los tonos de un abanico dan una vuelta entera",
    "Mass of the lower bob. Cannot be keyed: the whole motion follows from it":
        "Masa de la lenteja inferior. No admite claves: todo el movimiento depende de ello",
    "Angle of the lower rod when the motion starts, from hanging down. Cannot be keyed: the whole motion follows from it":
        "Ángulo de la varilla inferior al empezar el movimiento, desde la vertical. No admite claves: todo el movimiento depende de ello",
    "Length of the lower rod, before the pivot's scale. Cannot be keyed: the whole motion follows from it":
        "Longitud de la varilla inferior, sin la escala del pivote. No admite claves: todo el movimiento depende de ello",
    "Index of the pendulum in its fan; the other pendulums keep their angles to it":
        "Índice del péndulo en su abanico; los demás conservan sus ángulos con él",
    "Speed of the pendulum's time; it may be keyed, and a negative speed runs backwards":
        "Velocidad del tiempo del péndulo; admite claves, y una negativa va hacia atrás",
    "Index of the rod in its pendulum and fan": "Índice de la varilla en su péndulo y abanico",
    "Radius of the rods": "Radio de las varillas",
    "Mass of the upper bob; it counts beside that of the lower bob. Cannot be keyed: the whole motion follows from it":
        "Masa de la lenteja superior; cuenta junto a la de la inferior. No admite claves: todo el movimiento depende de ello",
    "Angle of the upper rod when the motion starts, from hanging down. Cannot be keyed: the whole motion follows from it":
        "Ángulo de la varilla superior al empezar el movimiento, desde la vertical. No admite claves: todo el movimiento depende de ello",
    "Length of the upper rod, before the pivot's scale. Cannot be keyed: the whole motion follows from it":
        "Longitud de la varilla superior, sin la escala del pivote. No admite claves: todo el movimiento depende de ello",
    "One rod with a bob": "Una varilla con una lenteja",
    "Other Angles": "Otros ángulos",
    "Pause": "Pausa",
    "Pause what plays, and play what is paused": "Pausa lo que corre, y reanuda lo pausado",
    "Pendulum Trails": "Estelas de péndulo",
    "Pendulum Presets": "Preajustes de péndulo",
    "Period": "Periodo",
    "Pivot": "Pivote",
    "Placed": "Puesta",
    "Play": "Reproducir",
    "Playing": "En marcha",
    "Playing or Speed is driven, or in NLA strips that are not known ahead: its present value counts for all the time":
        "En marcha o Velocidad tiene un controlador, o franjas NLA que no se conocen de antemano: su valor actual vale "
        "para todo el tiempo",
    "Press the left mouse button on the end bob and drag it; Esc or the right button cancels":
        "Pulsa el botón izquierdo sobre la lenteja del extremo y arrástrala; Esc o el botón derecho cancela",
    "Rest": "Reposo",
    "Rod": "Varilla",
    "Rod Radius": "Radio de varilla",
    "Rod that the pendulum turns": "Varilla que el péndulo gira",
    "Rods": "Varillas",
    "Scene Gravity": "Gravedad de la escena",
    "Select the bobs, and the pivot as the active object":
        "Selecciona las lentejas, y el pivote como objeto activo",
    "Select the object that shall be the pivot": "Selecciona el objeto que será el pivote",
    "Selected Objects": "Objetos seleccionados",
    "Rate at which velocity is lost, in 1/s; 0 swings for ever. Cannot be keyed: the whole motion follows from it":
        "Ritmo al que se pierde la velocidad, en 1/s; con 0 oscila para siempre. No admite claves: todo el movimiento depende de ello",
    "Single": "Simple",
    "Take a paused pendulum's end bob elsewhere; the motion starts from there, at rest, and replaces the earlier one":
        "Lleva a otro lugar la lenteja del extremo de un péndulo en pausa; el movimiento parte de ahí, en reposo, y sustituye al anterior",
    "Take the pendulum off its pivot, with the rods and bobs that were made for it":
        "Quita el péndulo de su pivote, con las varillas y lentejas que se crearon para él",
    "Take the strength of the scene's gravity. Cannot be keyed: the whole motion follows from it":
        "Toma la intensidad de la gravedad de la escena. No admite claves: todo el movimiento depende de ello",
    "The active object is the pivot and the other selected ones, one or two, are the bobs: lengths and angles are theirs":
        "El objeto activo es el pivote y los otros seleccionados, uno o dos, son las lentejas: de ellos son longitudes y ángulos",
    "The bob was there before, and is given back": "La lenteja existía antes, y se devuelve",
    "The demonstration has pivots of its own": "La demostración tiene sus propios pivotes",
    "The fan has {count} pendulums": "El abanico tiene {count} péndulos",
    "The lengths must be greater than 0": "Las longitudes deben ser mayores que 0",
    "The limits must be greater than 0": "Los límites deben ser mayores que 0",
    "The masses must be greater than 0": "Las masas deben ser mayores que 0",
    "The motion is not known so far from its start: start it later, or let it run more slowly, or without damping":
        "El movimiento no se conoce tan lejos de su inicio: empiézalo más tarde, o hazlo más lento, o sin amortiguación",
    "The motion of so many pendulums is not known so far from its start: start it later, let it run more slowly, or take fewer":
        "El movimiento de tantos péndulos no se conoce tan lejos de su inicio: empiézalo más tarde, hazlo más lento, o toma menos",
    "The motion starts at frame {frame} now: the earlier motion is replaced":
        "El movimiento empieza ahora en el fotograma {frame}: sustituye al movimiento anterior",
    "The pendulum hangs on the active object, which may be animated":
        "El péndulo cuelga del objeto activo, que puede estar animado",
    "The pendulum is playing: pause it first, or go to its start":
        "El péndulo está en marcha: ponlo antes en pausa, o ve a su inicio",
    "Whether the pendulum's time runs; keyed off it stands still":
        "Si corre el tiempo del péndulo; con una clave que lo apaga se detiene",
    "The pivot is in no collection any more: the rods hang as they are placed":
        "El pivote ya no está en ninguna colección: las varillas cuelgan como están puestas",
    "The pivot's motion is felt only while the pendulum plays all the time at one speed above 0":
        "El movimiento del pivote solo se nota si el péndulo está siempre en marcha a una misma velocidad mayor que 0",
    "The pivot's motion is not known ahead, and is not felt: record it, or key it":
        "El movimiento del pivote no se conoce de antemano, y no se nota: grábalo, o ponle claves",
    "There are no rods: they are another pivot's, or were deleted":
        "No hay varillas: son de otro pivote, o se borraron",
    "Time": "Tiempo",
    "Toggle": "Alternar",
    "Transform of the bob at the end of its rod": "Transformación de la lenteja en el extremo de su varilla",
    "Velocity": "Velocidad angular",
    "Velocity Limit": "Límite de velocidad",
    "What a placed bob's parent inverse was": "Cuál era la inversa del padre de una lenteja puesta",
    "What hangs at the end of the rod": "Lo que cuelga del extremo de la varilla",
    "What is added": "Qué se agrega",
    "Whether the time runs or stands still from the present frame on":
        "Si el tiempo corre o se detiene desde el fotograma actual",
    "What the pendulum hangs on": "De qué cuelga el péndulo",
    "Place in the world that the end bob is dragged to": "Lugar del mundo al que se arrastra la lenteja del extremo",
    "A rod of the pendulum, by which it is found if the pivot is gone": "Una varilla del péndulo, por la que se la encuentra si falta el pivote",
    "A setting of the trail is not a finite number": "Un ajuste de la estela no es un número finito",
    "A trail is computed from the pendulum on each frame: there is nothing to bake":
        "Una estela se calcula a partir del péndulo en cada fotograma: no hay nada que capturar",
    "Double pendulums that start half a degree apart and soon go ways of their own, one of them alone, and one with other "
    "angles":
        "Péndulos dobles que empiezan a medio grado unos de otros y pronto van cada uno por su lado, uno de ellos solo, y uno "
        "con otros ángulos",
    "Fade": "Desvanecimiento",
    "Fan of Chaos": "Abanico del caos",
    "How far back the trail goes, in seconds of the pendulum's time":
        "Hasta dónde llega la estela hacia atrás, en segundos del tiempo del péndulo",
    "How much the trail vanishes towards its end": "Cuánto se desvanece la estela hacia su final",
    "Object that shows the ways of the end bobs": "Objeto que muestra los caminos de las lentejas de los extremos",
    "Radius of the trail, before the pivot's scale": "Radio de la estela, sin la escala del pivote",
    "Show the ways that the end bobs have come; the demonstration always does":
        "Muestra los caminos que han recorrido las lentejas de los extremos; la demostración siempre lo hace",
    "Show the ways that the end bobs of a pendulum have come, as tubes in the bobs' colours":
        "Muestra los caminos que han recorrido las lentejas de los extremos de un péndulo, como tubos de sus colores",
    "Take the trails of a pendulum away": "Quita las estelas de un péndulo",
    "The pendulum of this trail is gone": "El péndulo de esta estela ya no está",
    "Thickness": "Grosor",
    "Trail": "Estela",
    "Trails": "Estelas",
    "Whether the trail is shown: 0 hides it": "Si se muestra la estela: 0 la oculta",
    "Pivot of the pendulum whose way the trail shows": "Pivote del péndulo cuyo camino muestra la estela",
    "{object} has no trails": "{object} no tiene estelas",
    "{keyword} must be greater than 0": "{keyword} debe ser mayor que 0",
    "{keyword} must not be less than 0": "{keyword} no debe ser menor que 0",
    "{object} has a parent: clear that first": "{object} tiene un padre: quítalo antes",
    "{object} has a pendulum: remove that first": "{object} tiene un péndulo: quítalo antes",
    "{object} is part of a pendulum": "{object} es parte de un péndulo",
    "{object} lies beside the plane of the pivot's X and Z axes: turn the pivot":
        "{object} está fuera del plano de los ejes X y Z del pivote: gira el pivote",
    "{object} lies on what it shall hang on": "{object} está sobre aquello de lo que ha de colgar",
}

OPERATORS = {
    "Add Pendulum": "Agregar péndulo",
    "Add Trails": "Agregar estelas",
    "Remove Trails": "Quitar estelas",
    "Use Pendulum Preset": "Usar preajuste de péndulo",
    "Add Pendulum Preset": "Agregar preajuste de péndulo",
    "Drag Pendulum": "Arrastrar péndulo",
    "Pause": "Pausa",
    "Pendulum of the Selected": "Péndulo de los seleccionados",
    "Play": "Reproducir",
    "Play or Pause Pendulum": "Reproducir o pausar péndulo",
    "Remove Pendulum": "Quitar péndulo",
    "Select Pivot": "Seleccionar pivote",
}
