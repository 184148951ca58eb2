"""Spanish: walkers."""

_NO_KEYS_ES = ". No admite claves: todo el movimiento depende de ello"
_NO_KEYS = ". Cannot be keyed: the whole motion follows from it"

INTERFACE = {
    "Walker": "Caminante",
    "The body or the ground moves with what the walker drives: what would wait for itself is left alone":
        "El cuerpo o el suelo se mueve con lo que impulsa el caminante: se deja en paz lo que se esperaría a sí mismo",
    "Some legs have no foot any more: add the walker again": "Algunas patas ya no tienen pie: vuelve a agregar el caminante",
    "The body that rises and leans is gone, or hangs on something else: choose it anew":
        "El cuerpo que sube y se inclina ya no está, o cuelga de otra cosa: vuelve a elegirlo",
    "Some feet do not reach the ground at their footholds": "Algunos pies no llegan al suelo en sus apoyos",
    "The walk is planned for the frames of the scene: here the feet stand":
        "La marcha está planeada para los fotogramas de la escena: aquí los pies están quietos",
    "Select the body that shall walk": "Selecciona el cuerpo que debe caminar",
    "Nothing here walks": "Aquí nada camina",
    "{foot} would be the foot of two legs": "{foot} sería el pie de dos patas",
    "{object} would have {count} legs; there can be {most}": "{object} tendría {count} patas; puede haber {most}",
    "{object} is no child of {parent}: parent it, and move {parent}":
        "{object} no es hijo de {parent}: emparéntalo y mueve {parent}",
    "{object} walks itself, and is no ground": "{object} camina también, y no es suelo",
    "{object} has no chain of Inverse Kinematics with a target: add some, or name the feet":
        "{object} no tiene ninguna cadena de cinemática inversa con objetivo: agrega alguna, o nombra los pies",
    "Name the objects that are the feet of {object}, or select them too":
        "Nombra los objetos que son los pies de {object}, o selecciónalos también",
    "{object} cannot be its own foot": "{object} no puede ser su propio pie",
    "{object} cannot be the body, and a foot too": "{object} no puede ser el cuerpo y a la vez un pie",
    "{object} walks itself, and can be no part of {owner}": "{object} camina por su cuenta, y no puede ser parte de {owner}",
    "{object} is part of {leader}, which walks already": "{object} es parte de {leader}, que ya camina",
    "{bone} is connected to its parent, and cannot be a foot": "{bone} está conectado a su padre, y no puede ser un pie",
    "Spider": "Araña",
    "Eight legs in two groups, a body that hangs calmly between them":
        "Ocho patas en dos grupos y un cuerpo que cuelga tranquilo entre ellas",
    "Hunter": "Cazadora",
    "Quick steps, and a body that goes along with them": "Pasos rápidos y un cuerpo que los acompaña",
    "Insect": "Insecto",
    "Two halves that take turns without a pause": "Dos mitades que se turnan sin pausa",
    "Crawler": "Reptante",
    "Waves of steps from the back to the front": "Ondas de pasos de atrás adelante",
    "Cautious": "Cauto",
    "A single leg at a time, under a body that hardly moves": "Una sola pata cada vez, bajo un cuerpo que apenas se mueve",
    "Horse": "Caballo",
    "Diagonal halves take turns, and the body swings a little": "Las mitades diagonales se turnan, y el cuerpo se balancea un poco",
    "Camel": "Camello",
    "The legs of a side go together, and the body rolls": "Las patas de un lado van juntas, y el cuerpo se mece",
    "Machine": "Máquina",
    "A stiff body, exactly where its feet have it": "Un cuerpo rígido, exactamente donde lo tienen sus pies",
    "Tetrapod": "Tetrápodo",
    "Every second leg of a side with the others of the other side, as spiders go":
        "Una de cada dos patas de un lado con las otras del otro lado, como van las arañas",
    "Tripod": "Trípode",
    "Every second leg of a side with the others of the other side, in two halves that take turns without a pause, as insects run":
        "Una de cada dos patas de un lado con las otras del otro lado, en dos mitades que se turnan sin pausa, como corren los insectos",
    "Ripple": "Onda doble",
    "One leg after the other from the back to the front, the sides half a cycle apart":
        "Una pata tras otra de atrás adelante, con medio ciclo entre los lados",
    "Wave": "Onda",
    "A single leg at a time, slow and safe": "Una sola pata cada vez, lento y seguro",
    "Trot": "Trote",
    "Diagonal halves take turns": "Las mitades diagonales se turnan",
    "Pace": "Ambladura",
    "Left and right legs take turns": "Las patas izquierdas y derechas se turnan",
    "The phase of each leg is a setting of its own": "La fase de cada pata es un ajuste propio",
    "Gait": "Paso",
    "Which legs step together, and which after them": "Qué patas pisan juntas, y cuáles después",
    "Custom Duty": "Apoyo personalizado",
    "Set how long feet stand, instead of what the gait says": "Fija cuánto apoyan los pies, en vez de lo que dice el paso",
    "Duty": "Apoyo",
    "Share of a cycle for which each foot stands" + _NO_KEYS: "Parte de un ciclo durante la que apoya cada pie" + _NO_KEYS_ES,
    "Stride": "Zancada",
    "How far the body goes while a foot stands, at most" + _NO_KEYS:
        "Cuánto avanza el cuerpo, como máximo, mientras un pie apoya" + _NO_KEYS_ES,
    "Cadence": "Cadencia",
    "Cycles of all legs in a second, at least; a fast body has more" + _NO_KEYS:
        "Ciclos de todas las patas por segundo, como mínimo; un cuerpo rápido tiene más" + _NO_KEYS_ES,
    "Clearance": "Despegue",
    "How high feet are carried above the ground" + _NO_KEYS: "A qué altura sobre el suelo se llevan los pies" + _NO_KEYS_ES,
    "Minimum Step": "Paso mínimo",
    "Feet that are no further than this from their rest positions do not step, so that a trembling body does not patter" + _NO_KEYS:
        "Los pies que no están más lejos que esto de sus posiciones de reposo no dan pasos, para que un cuerpo que tiembla no patalee" + _NO_KEYS_ES,
    "Reach Up": "Alcance arriba",
    "How far above the feet's rest positions ground is searched for" + _NO_KEYS:
        "Hasta qué altura sobre las posiciones de reposo de los pies se busca suelo" + _NO_KEYS_ES,
    "Reach Down": "Alcance abajo",
    "How far below the feet's rest positions ground is searched for" + _NO_KEYS:
        "Hasta qué profundidad bajo las posiciones de reposo de los pies se busca suelo" + _NO_KEYS_ES,
    "Walk on a level plane too, beside the meshes": "Caminar también sobre un plano horizontal, además de las mallas",
    "Height of the plane, along the world's Z axis" + _NO_KEYS: "Altura del plano, según el eje Z del mundo" + _NO_KEYS_ES,
    "How much the body rises and sinks with the feet that stand" + _NO_KEYS:
        "Cuánto sube y baja el cuerpo con los pies que apoyan" + _NO_KEYS_ES,
    "Rise": "Elevación",
    "Tilt": "Inclinación",
    "How much the body leans with the feet that stand" + _NO_KEYS: "Cuánto se inclina el cuerpo con los pies que apoyan" + _NO_KEYS_ES,
    "How quickly the body follows its feet, in Hz" + _NO_KEYS: "Con qué rapidez sigue el cuerpo a sus pies, en Hz" + _NO_KEYS_ES,
    "Damping of the body over its feet; below 1 the body overshoots and swings" + _NO_KEYS:
        "Amortiguación del cuerpo sobre sus pies; por debajo de 1 el cuerpo se pasa y oscila" + _NO_KEYS_ES,
    "Jump": "Salto",
    "A body that goes further than this from one frame to the next jumps, and its feet with it; 0 takes four strides" + _NO_KEYS:
        "Un cuerpo que va más lejos que esto de un fotograma al siguiente salta, y sus pies con él; 0 toma cuatro zancadas" + _NO_KEYS_ES,
    "Axis of the body that points ahead": "Eje del cuerpo que apunta hacia delante",
    "Axis of the body that points away from the ground": "Eje del cuerpo que se aleja del suelo",
    "How much the walk moves feet and body; 0 leaves them to their own animation":
        "Cuánto mueve la marcha los pies y el cuerpo; 0 los deja a su propia animación",
    "Position of the foot, in the body's space, if the body stands on level ground":
        "Posición del pie, en el espacio del cuerpo, si este está sobre suelo llano",
    "Rest": "Reposo",
    "Hip": "Cadera",
    "Position where the leg begins, in the body's space": "Posición donde empieza la pata, en el espacio del cuerpo",
    "Length of the whole leg, before the body's scale; 0 for a leg that reaches everywhere" + _NO_KEYS:
        "Longitud de toda la pata, antes de la escala del cuerpo; 0 para una que llega a todas partes" + _NO_KEYS_ES,
    "Phase": "Fase",
    "Position of the leg in the cycle: legs of the same phase step together" + _NO_KEYS:
        "Posición de la pata en el ciclo: las de una misma fase pisan juntas" + _NO_KEYS_ES,
    "Bone of the armature that is the foot; empty where it is an object": "Hueso del esqueleto que es el pie; vacío si es un objeto",
    "Foot": "Pie",
    "Object that is the foot": "Objeto que es el pie",
    "Legs": "Patas",
    "Object below the one that is moved, which rises and leans with the feet":
        "Objeto hijo del que se mueve, que sube y se inclina con los pies",
    "Bone of the armature that rises and leans with the feet": "Hueso del esqueleto que sube y se inclina con los pies",
    "Mesh object that the feet stand on": "Objeto de malla sobre el que apoyan los pies",
    "Collection whose mesh objects the feet stand on": "Colección sobre cuyos objetos de malla apoyan los pies",
    "Steps": "Pasos",
    "At Rest From": "En reposo desde",
    "{sentence}, and {count} more footholds": "{sentence}, y {count} apoyos más",
    "{foot} finds no ground within reach on frames {first}-{last}":
        "{foot} no encuentra suelo a su alcance en los fotogramas {first}-{last}",
    "{foot} is too far from its leg on frames {first}-{last}": "{foot} está demasiado lejos de su pata en los fotogramas {first}-{last}",
    "The leg of {foot} has no length": "La pata de {foot} no tiene longitud",
    "There are no legs: add the walker again, and name its feet": "No hay patas: vuelve a agregar el caminante y nombra sus pies",
    "A setting is not a finite number": "Un ajuste no es un número finito",
    "{setting} is not a finite number": "{setting} no es un número finito",
    "The body's motion is not a finite number": "El movimiento del cuerpo no es un número finito",
    "The body goes too far away for its steps to be planned": "El cuerpo se va demasiado lejos para planear sus pasos",
    "The walk has more than 1,000,000 steps: a longer stride, a slower body or a lower cadence has fewer":
        "La marcha tiene más de 1.000.000 de pasos: una zancada más larga, un cuerpo más lento o una cadencia menor da menos",
    "A setting is outside of what a walk can be planned by": "Un ajuste está fuera de lo que permite planear una marcha",
    "{setting} is outside of what a walk can be planned by": "{setting} está fuera de lo que permite planear una marcha",
    "The body's motion is not known ahead, and its feet do not step: record it, or key it":
        "El movimiento del cuerpo no se conoce de antemano, y sus pies no pisan: grábalo, o ponle claves",
    "The body was moved away from its keys: its feet stand below it until it is keyed here":
        "El cuerpo se ha apartado de sus claves: sus pies están debajo de él hasta que se pongan claves aquí",
    "The body is not where it was recorded, and its feet stand below it: record it again, here too":
        "El cuerpo no está donde se grabó, y sus pies están debajo de él: vuelve a grabarlo, también aquí",
    "Only the first 9,000 frames of the body's motion are walked: beyond, the feet stand":
        "Solo se caminan los primeros 9.000 fotogramas del movimiento del cuerpo: más allá, los pies están quietos",
    "The ground is gone: choose another one": "El suelo ya no está: elige otro",
    "The ground has no faces": "El suelo no tiene caras",
    "Ground that may move is left out: feet do not stand on it": "Se deja fuera el suelo que puede moverse: los pies no apoyan en él",
    "Footholds": "Apoyos",
    "Draw where feet stand, and how they come there, around the present frame":
        "Dibujar dónde apoyan los pies, y cómo llegan, alrededor del fotograma actual",
    "Rest Positions": "Posiciones de reposo",
    "Draw the rest position of each foot below the body": "Dibujar la posición de reposo de cada pie bajo el cuerpo",
    "Let the feet of a body step by themselves while the body moves; where they stand now become their rest positions":
        "Deja que los pies de un cuerpo pisen solos mientras este se mueve; donde están ahora son sus posiciones de reposo",
    "Remove the walker, so that feet and body have their own animation again":
        "Quitar el caminante, de modo que pies y cuerpo vuelven a su propia animación",
    "Set the rest positions of the feet to where their own transforms have them on this frame":
        "Fijar las posiciones de reposo de los pies donde los tienen sus propias transformaciones en este fotograma",
    "Select the body whose settings drive this one": "Selecciona el cuerpo cuyos ajustes impulsan este",
    "Name of the body that is moved, such as the armature; empty takes the active object":
        "Nombre del cuerpo que se mueve, como el esqueleto; vacío toma el objeto activo",
    "Name of the body that walks; empty takes the active object": "Nombre del cuerpo que camina; vacío toma el objeto activo",
    "Name of a mesh object that the feet stand on": "Nombre de un objeto de malla sobre el que apoyan los pies",
    "Name of a collection whose mesh objects the feet stand on":
        "Nombre de una colección sobre cuyos objetos de malla apoyan los pies",
    "Feet": "Pies",
    "Names of the feet with commas between: bones of the armature, or objects; empty takes the targets of its chains, or the other "
    "selected objects":
        "Nombres de los pies separados por comas: huesos del esqueleto, u objetos; vacío toma los objetivos de sus cadenas, o los demás "
        "objetos seleccionados",
    "Name of the bone, or of the child object, that rises and leans with the feet; empty leaves the one that is there, or takes the bone that all chains "
    "hang on":
        "Nombre del hueso, o del objeto hijo, que sube y se inclina con los pies; vacío deja el que ya hay, o toma el hueso del que cuelgan "
        "todas las cadenas",
    "{object} walks on {count} legs": "{object} camina con {count} patas",
    "Rest positions of {count} feet updated": "Posiciones de reposo de {count} pies actualizadas",
    "Make a spider that walks wherever its armature is moved: key it, or let it follow a path":
        "Hace una araña que camina adonde se mueva su esqueleto: ponle claves, o haz que siga una trayectoria",
    "Number of the spider's legs": "Número de patas de la araña",
    "Span": "Envergadura",
    "Distance between the feet of one side and the other": "Distancia entre los pies de un lado y del otro",
    "Color of the bands on the legs, and of the pattern on the back":
        "Color de las bandas de las patas y del dibujo del dorso",
    "Location of the spider; that of the 3D cursor if it is not given":
        "Posición de la araña; la del cursor 3D si no se indica",
    "Spiders on the Wall": "Arañas en el muro",
    "A spider goes over the stones of a garden and up an old wall, and her young go after her":
        "Una araña pasa sobre las piedras de un jardín y sube por un viejo muro, y sus crías la siguen",
    "Walker Presets": "Preajustes de caminante",
}

OPERATORS = {
    "Add Walker": "Agregar caminante",
    "Remove Walker": "Quitar caminante",
    "Set Rest Positions from Pose": "Fijar posiciones de reposo según la pose",
    "Select Walker": "Seleccionar caminante",
    "Add Spider": "Agregar araña",
    "Add Walker Preset": "Agregar preajuste de caminante",
    "Use Walker Preset": "Usar preajuste de caminante",
}
