"""Spanish: inverse kinematics."""

INTERFACE = {
    "New Control Bone": "Nuevo hueso de control",
    "Make a bone of the armature itself the target, which stands at the end of the chain, has no parent and deforms nothing; a "
    "pole that is made is such a bone too":
        "Hace que el objetivo sea un hueso del propio esqueleto, que está al final de la cadena, no tiene padre y no deforma "
        "nada; un polo que se cree es también un hueso así",
    "Make a bone of the armature itself the target, which stands where the target is, has no parent and deforms nothing":
        "Hace que el objetivo sea un hueso del propio esqueleto, que está donde está el objetivo, no tiene padre y no deforma nada",
    "Give the chain a pole at the side that it bends to; nothing moves by that":
        "Da a la cadena un polo del lado hacia el que se dobla; con eso no se mueve nada",
    "As Bone": "Como hueso",
    "Drag Chain": "Arrastrar cadena",
    "Make a control bone of the armature instead of an empty": "Crea un hueso de control del esqueleto en vez de un vacío",
    "{bone} has a pole already: {pole}": "{bone} ya tiene un polo: {pole}",
    "The armature of {object} is linked from another file and can be given no bones: choose an object":
        "El esqueleto de {object} está enlazado desde otro archivo y no admite huesos nuevos: elige un objeto",
    "Target {bone}": "Objetivo {bone}",
    "Pole {bone}": "Polo {bone}",
    "Something else needs {targets}, so that they stay": "Otra cosa necesita {targets}, así que se quedan",
    "Take hold of a bone at any point with the left mouse button; the chain follows the mouse.\nX, Y and Z hold it to an axis; a "
    "click selects the bone":
        "Coge un hueso por cualquier punto con el botón izquierdo del ratón; la cadena sigue al ratón.\nX, Y y Z lo fijan a un eje; "
        "un clic selecciona el hueso",
    "All connected bones up to a branch": "Todos los huesos conectados hasta una bifurcación",
    "Limb": "Extremidad",
    "Slows down a little before it is straight, so that the knee does not snap":
        "Frena un poco antes de estar recta, para que la rodilla no salte",
    "Exact": "Exacta",
    "Reaches as far as its bones are long": "Alcanza tanto como miden sus huesos",
    "Cartoon": "Dibujos animados",
    "Lengthens until it reaches the target": "Se alarga hasta llegar al objetivo",
    "Lengthens by half of the missing distance": "Se alarga la mitad de la distancia que falta",
    "Jointed": "Articulada",
    "Keeps the limits that the bones have": "Respeta los límites que tienen los huesos",
    "0 is the target, 1 the first of the further targets, and between them the way from one to the other":
        "0 es el objetivo, 1 el primero de los demás objetivos, y entre ellos el camino de uno a otro",
    "A joint limit is in the way: {length} are left": "Lo impide un límite de articulación: faltan {length}",
    "A number of this chain is not finite": "Un número de esta cadena no es finito",
    "A target that Blend needs is missing: the one before it counts instead":
        "Falta un objetivo que la mezcla necesita: en su lugar cuenta el anterior",
    "Active Chain": "Cadena activa",
    "Active Further Target": "Otro objetivo activo",
    "Angle Left": "Ángulo restante",
    "Away": "En contra",
    "Bend": "Flexión",
    "Bend Axis": "Eje de flexión",
    "Blend": "Mezcla",
    "Bone": "Hueso",
    "Bone at the end of the chain": "Hueso del final de la cadena",
    "Bone of the object; empty takes its origin": "Hueso del objeto; vacío toma su origen",
    "Bone of the pole; empty takes its origin": "Hueso del polo; vacío toma su origen",
    "Bone of the target; empty takes its origin": "Hueso del objetivo; vacío toma su origen",
    "Bones in the chain, counted upwards; 0 takes all of them up to the root":
        "Huesos de la cadena, contados hacia arriba; 0 los toma todos hasta la raíz",
    "Chain Length": "Longitud de la cadena",
    "Chains": "Cadenas",
    "Chosen Chain": "Cadena elegida",
    "Delete the targets and poles too that were made along with the chains":
        "Borrar también los objetivos y polos que se crearon con las cadenas",
    "Angle about the first bone, from its X axis, of the axis that a chain bends about if its animated pose is straight":
        "Ángulo alrededor del primer hueso, desde su eje X, del eje en torno al que se dobla una cadena si su pose animada es recta",
    "Distance from the target that counts as reached, as a fraction of the chain's length":
        "Distancia al objetivo que cuenta como alcanzado, como fracción de la longitud de la cadena",
    "Draw how far a chain reaches, and how near": "Dibujar hasta dónde llega una cadena, de lejos y de cerca",
    "Draw the line from the middle of a chain to its pole": "Dibujar la línea del medio de una cadena a su polo",
    "Draw what is left between the end of a chain and its target":
        "Dibujar lo que falta entre el final de una cadena y su objetivo",
    "Elastic": "Elástica",
    "Blend from the animated pose (0) to the one that reaches the target (1)":
        "Mezcla de la pose animada (0) a la que alcanza el objetivo (1)",
    "Further Targets": "Otros objetivos",
    "IK on {bone}": "IK en {bone}",
    "IK on {bone} to {target}": "IK en {bone} hacia {target}",
    "IK on {count} Bones": "IK en {count} huesos",
    "IK added to {count} bones": "IK agregada a {count} huesos",
    "Names of the last bones of several chains, with commas between: all are added at once":
        "Nombres de los últimos huesos de varias cadenas, separados por comas: se agregan todas a la vez",
    "Give the chain a further target, which Blend passes to": "Dar a la cadena otro objetivo, al que pasa la mezcla",
    "Go to Object Mode or Pose Mode first": "Ve antes al modo Objeto o al modo Pose",
    "How far the last bone takes the target's orientation; the rest of the chain still reaches":
        "Cuánto toma el último hueso la orientación del objetivo; el resto de la cadena sigue alcanzándolo",
    "How much all chains of the rig act; 0 leaves the rig to its animation":
        "Cuánto actúan todas las cadenas del rig; 0 deja el rig a su animación",
    "Share of the missing distance by which the bones lengthen":
        "Parte de la distancia que falta en la que se alargan los huesos",
    "Inverse Kinematics": "Cinemática inversa",
    "Inverse Kinematics Presets": "Preajustes de cinemática inversa",
    "Iterations": "Iteraciones",
    "Keep Rotation": "Mantener rotación",
    "Keep the limits that the bones have for inverse kinematics":
        "Respetar los límites que tienen los huesos para la cinemática inversa",
    "Remove Inverse Kinematics, so that the chains have their own animation again":
        "Quitar Cinemática inversa, de modo que las cadenas vuelven a su propia animación",
    "Switch the chain off: it keeps its own animation": "Desactivar la cadena: conserva su propia animación",
    "Let a chain of bones reach for a target": "Hacer que una cadena de huesos alcance un objetivo",
    "Length": "Longitud",
    "Limits": "Límites",
    "Make a Pole": "Crear un polo",
    "Make an empty at the side that the chain bends to": "Crear un vacío en el lado hacia el que se dobla la cadena",
    "Mute": "Silenciar",
    "Name of a bone of the pole": "Nombre de un hueso del polo",
    "Name of a bone of the target": "Nombre de un hueso del objetivo",
    "Name of the armature; empty takes the active one": "Nombre del esqueleto; vacío toma el activo",
    "Name of the last bone of the chain; empty takes all chains of the object":
        "Nombre del último hueso de la cadena; vacío toma todas las cadenas del objeto",
    "Name of the last bone of the chain; empty takes the active one":
        "Nombre del último hueso de la cadena; vacío toma el activo",
    "Name of the object that the chain bends towards": "Nombre del objeto hacia el que se dobla la cadena",
    "Name of the object that the chain reaches for; empty takes what is selected along with the bone, and else makes an empty at the end of the chain":
        "Nombre del objeto que la cadena alcanza; vacío toma lo seleccionado junto con el hueso y, si no hay nada, crea un vacío al final de la cadena",
    "Name of the object; empty takes what is selected along with the bone":
        "Nombre del objeto; vacío toma lo seleccionado junto con el hueso",
    "Name the armature of the bone {bone}": "Indica el esqueleto del hueso {bone}",
    "Nothing here has inverse kinematics": "Nada aquí tiene cinemática inversa",
    "Object that the chain can go to as well": "Objeto al que la cadena también puede ir",
    "Pole": "Polo",
    "Pole Angle": "Ángulo del polo",
    "Pole Bone": "Hueso del polo",
    "Position": "Posición",
    "Precision": "Precisión",
    "Reach": "Alcance",
    "Remove Controls": "Quitar controles",
    "Falls Short By": "Le falta",
    "What Is Missing": "Lo que falta",
    "Rig Influence": "Influencia del rig",
    "Rotation": "Rotación",
    "Chain": "Cadena",
    "Select an armature, and the last bone of the chain in Pose Mode":
        "Selecciona un esqueleto y, en el modo Pose, el último hueso de la cadena",
    "Select the last bone of the chain in Pose Mode": "Selecciona en el modo Pose el último hueso de la cadena",
    "Set the rotation offset so that the bone keeps its present rotation":
        "Ajustar el desfase de rotación para que el hueso mantenga su rotación actual",
    "Share of the chain's length over which it slows down before it is straight":
        "Parte de la longitud de la cadena en la que frena antes de quedar recta",
    "Softness": "Suavidad",
    "With the target's orientation {length} are left": "Con la orientación del objetivo faltan {length}",
    "Softness keeps the chain {length} from the target": "La suavidad mantiene la cadena a {length} del objetivo",
    "Some chains have no target that they could reach for: the list says why":
        "Algunas cadenas no tienen objetivo que alcanzar: la lista dice por qué",
    "Stretch": "Estiramiento",
    "Stretch is not 0": "El estiramiento no es 0",
    "Stretch or Length was keyed or driven after the chain was made: press Refresh":
        "El estiramiento o la longitud recibió claves o un controlador después de hacerse la cadena: pulsa Actualizar",
    "Take a further target off the chain": "Quitar a la cadena otro objetivo",
    "Target": "Objetivo",
    "Target Bone": "Hueso del objetivo",
    "The bone's tail goes to the target; off, its head does, and the chain ends with the bone above it":
        "La cola del hueso va al objetivo; desactivado va su cabeza, y la cadena termina en el hueso anterior",
    "The iterations were used up: {length} are left": "Se agotaron las iteraciones: faltan {length}",
    "The middle of the chain bends away from the pole": "El medio de la cadena se dobla en contra del polo",
    "The middle of the chain bends towards the pole": "El medio de la cadena se dobla hacia el polo",
    "The rig's bones have changed: press Refresh": "Los huesos del esqueleto han cambiado: pulsa Actualizar",
    "The target is {length} too far away": "El objetivo está {length} demasiado lejos",
    "The target is {length} too near": "El objetivo está {length} demasiado cerca",
    "The target moves with the chain itself: choose another one":
        "El objetivo se mueve con la propia cadena: elige otro",
    "There are only {count} bones up to the root: the chain takes all of them":
        "Solo hay {count} huesos hasta la raíz: la cadena los toma todos",
    "There is no such target": "No existe ese objetivo",
    "Tolerance": "Tolerancia",
    "Towards": "A favor",
    "Turns the chain about the line from its root to the target":
        "Gira la cadena en torno a la línea de su raíz al objetivo",
    "Turns the last bone away from the target's orientation, in the target's own space":
        "Gira el último hueso respecto a la orientación del objetivo, en el espacio de este",
    "Use Limits": "Usar límites",
    "Use Tail": "Usar cola",
    "Weights": "Pesos",
    "Object that the end of the chain goes to": "Objeto al que va el final de la cadena",
    "Object that the middle of the chain bends towards; without a pole the chain bends in the plane of the animated pose":
        "Objeto hacia el que se dobla el medio de la cadena; sin polo se dobla en el plano de la pose animada",
    "Number of iterations after which the search for a chain of more than two bones stops":
        "Número de iteraciones tras las que se detiene la búsqueda en una cadena de más de dos huesos",
    "Index of the further target; -1 is the active one": "Índice del otro objetivo; -1 es el activo",
    "Which side of the line from root to target the chain bends to":
        "Hacia qué lado de la línea de la raíz al objetivo se dobla la cadena",
    "{bone} has a constraint of its own that overrides its rotation: {constraint}":
        "{bone} tiene una restricción propia que impone su rotación: {constraint}",
    "{bone} has joint limits of its own: they count only with Use Tail":
        "{bone} tiene límites de articulación propios: solo cuentan con Usar cola",
    "{bone} has no parent whose tail could reach: switch Use Tail on":
        "{bone} no tiene un padre cuya cola pueda alcanzar: activa Usar cola",
    "{bone} has another chain in this list: choose another bone":
        "{bone} tiene ya otra cadena en esta lista: elige otro hueso",
    "Further target {number} is missing: the one before it counts instead":
        "Falta el otro objetivo {number}: en su lugar cuenta el anterior",
    "{bone} has no target: choose one": "{bone} no tiene objetivo: elige uno",
    "{bone} is driven by {system} of {other} already: shorten the chain":
        "{bone} ya lo mueve {system} de {other}: acorta la cadena",
    "{bone} of {object} has no inverse kinematics": "{bone} de {object} no tiene cinemática inversa",
    "IK added: {bone} follows {target}": "IK agregada: {bone} sigue a {target}",
    "IK added: {bone} follows bone {target}": "IK agregada: {bone} sigue al hueso {target}",
    "{object} has no bone {bone}": "{object} no tiene el hueso {bone}",
    "{object} has no bone {bone}: the chain bends as without a pole":
        "{object} no tiene el hueso {bone}: la cadena se dobla como sin polo",
    "{object} has no inverse kinematics": "{object} no tiene cinemática inversa",
    "{object} is not an armature": "{object} no es un esqueleto",
    "{pole} is in no collection any more: the chain bends as without a pole":
        "{pole} ya no está en ninguna colección: la cadena se dobla como sin polo",
    "{target} is in no collection any more: choose another target":
        "{target} ya no está en ninguna colección: elige otro objetivo",
    "{target} moves with the chain of {bone}: choose another one":
        "{target} se mueve con la cadena de {bone}: elige otro",
    "All frames from the start to the end; otherwise the current frame alone":
        "Todos los fotogramas del inicio al final; si no, solo el fotograma actual",
    "Frame Range": "Rango de fotogramas",
    "Frames from one to the next, less than one for sub-frames":
        "Fotogramas de uno al siguiente, menos de uno para subfotogramas",
    "Key the bones so that their own animation is the solution":
        "Pone claves en los huesos para que su propia animación sea la solución",
    "Key the targets and poles so that the solution is the animated pose":
        "Pone claves en los objetivos y polos para que la solución sea la pose animada",
    "Matched {frames} frames of {chains} chains: largest error {length} mm, {angle} degrees":
        "Se igualaron {frames} fotogramas de {chains} cadenas: error máximo {length} mm, {angle} grados",
    "Set both weights to 0 over these frames": "Poner ambos pesos a 0 en estos fotogramas",
    "Set the position weight to 1 over these frames": "Poner el peso de la posición a 1 en estos fotogramas",
    "Switch to FK": "Pasar a FK",
    "Switch to IK": "Pasar a IK",
    "No chain of {object} is being solved": "No se está resolviendo ninguna cadena de {object}",
    "The weights of {bone} are driven: switch them there": "Los pesos de {bone} tienen controladores: cámbialos allí",
    "{bone} has no pose at frame {frame} that could be matched":
        "{bone} no tiene en el fotograma {frame} una pose que se pueda igualar",
    "{bone} passes from one target to another in this range: match the frames before or after that":
        "{bone} pasa de un objetivo a otro en este intervalo: iguala los fotogramas anteriores o posteriores",
    "{target} has a constraint, so it cannot be moved: {constraint}":
        "{target} tiene una restricción, por lo que no se puede mover: {constraint}",
    "{target} is connected to its parent, so it cannot be moved":
        "{target} está conectado a su padre, por lo que no se puede mover",
    "{target} is moved by a driver": "Un controlador mueve {target}",
    "{target} is the control of several chains: give each one of its own":
        "{target} es el control de varias cadenas: da a cada una el suyo",
    "At Once": "De golpe",
    "The chain moves at an even speed": "La cadena se mueve a velocidad constante",
    "The chain jumps to the new target": "La cadena salta al nuevo objetivo",
    "Linear": "Lineal",
    "The chain starts and ends slowly": "La cadena empieza y termina despacio",
    "How the chain moves from one target to the other": "Cómo se mueve la cadena de un objetivo a otro",
    "Interpolation": "Interpolación",
    "Let the chain pass from its present target to another one, over frames or when something happens":
        "Hace que la cadena pase de su objetivo actual a otro, en unos fotogramas o cuando ocurre algo",
    "Frame at which the chain is at the other target; 12 after the start where it is not given":
        "Fotograma en que la cadena está en el otro objetivo; si no se indica, 12 después del inicio",
    "Frame at which the chain leaves its present target; the current frame if it is not given":
        "Fotograma en que la cadena deja su objetivo actual; si no se indica, el actual",
    "Name of the object to go to; empty takes what is selected along with the bone":
        "Nombre del objeto al que ir; vacío toma lo que está seleccionado junto con el hueso",
    "Name the target, or select it along with the bone": "Nombra el objetivo o selecciónalo junto con el hueso",
    "Trigger": "Desencadenante",
    "Name of an object, one of whose numbers, instead of the frame, says how far the chain has come":
        "Nombre de un objeto, uno de cuyos números, en vez del fotograma, dice cuánto ha avanzado la cadena",
    "Name of the system whose output triggers": "Nombre del sistema cuya salida desencadena",
    "Output": "Salida",
    "Name of the system's output: parameter, fraction, distance or speed of a follower, and what others compute":
        "Nombre de la salida del sistema: parameter, fraction, distance o speed de quien sigue un recorrido, y lo que calculan otros",
    "Data Path": "Ruta de datos",
    "Data path of a number of the trigger, instead of an output of a system":
        "Ruta de datos de un número del desencadenante, en vez de una salida de un sistema",
    "From": "Desde",
    "Value of the trigger at which the chain leaves its present target":
        "Valor del desencadenante con el que la cadena deja su objetivo actual",
    "To": "Hasta",
    "Value of the trigger at which the chain is at the other target":
        "Valor del desencadenante con el que la cadena está en el otro objetivo",
    "{bone} of {object} passes on to {target}": "{bone} de {object} pasa a {target}",
    "{bone} is at {target} already": "{bone} ya está en {target}",
    "{bone} passes from one target to another at frame {frame}: begin before or after that":
        "{bone} pasa de un objetivo a otro en el fotograma {frame}: empieza antes o después",
    "{bone} passes on too many times for one driver": "{bone} pasa demasiadas veces para un solo controlador",
    "Blend of {bone} has a driver of its own": "La mezcla de {bone} tiene un controlador propio",
    "Blend of {bone} is driven to targets that there are no more: remove its driver":
        "La mezcla de {bone} la lleva un controlador a objetivos que ya no hay: quita el controlador",
    "Blend of {bone} is keyed: remove the keys, or give frames instead of a trigger":
        "La mezcla de {bone} tiene claves: quítalas o indica fotogramas en vez de un desencadenante",
    "The range is empty: the end frame has to come after the start frame":
        "El intervalo está vacío: el fotograma final tiene que ir después del inicial",
    "The trigger's two values have to be different": "Los dos valores del desencadenante tienen que ser distintos",
    "{object} cannot wait for what is solved on its own bones: choose another trigger":
        "{object} no puede esperar lo que se calcula en sus propios huesos: elige otro desencadenante",
    "What triggers {bone} moves with the chain itself: choose another trigger":
        "Lo que desencadena {bone} se mueve con la propia cadena: elige otro desencadenante",
    "There is no system {system}": "No hay ningún sistema {system}",
    "{object} is not driven by {system}": "{object} no está movido por {system}",
    "{path} of {object} is no number": "{path} de {object} no es un número",
    "{system} of {object} has no output {output}": "{system} de {object} no tiene la salida {output}",
    "Take hold of a bone at any point; the chain follows the mouse":
        "Coge un hueso por cualquier punto; la cadena sigue al ratón",
    "Name of the bone that is pulled; empty takes the active one":
        "Nombre del hueso del que se tira; vacío toma el activo",
    "Factor": "Factor",
    "Point of the bone that is pulled, from its head (0) to its tail (1)":
        "Punto del hueso del que se tira, de su cabeza (0) a su cola (1)",
    "Location": "Posición",
    "Place in the world that the point is pulled to": "Lugar del mundo al que se lleva el punto",
    "How many bones without inverse kinematics follow; 0 takes those that are connected up to a branch":
        "Cuántos huesos sin cinemática inversa siguen; 0 toma los conectados hasta una bifurcación",
    "Press the left mouse button on a bone and drag it; Esc or the right button cancels":
        "Pulsa el botón izquierdo sobre un hueso y arrástralo; Esc o el botón derecho cancelan",
    "Say where to: location is missing": "Di adónde: falta location",
    "The point stays {length} away": "El punto se queda a {length}",
    "{bone} is between two targets: drag it where Blend stands on one of them":
        "{bone} está entre dos objetivos: arrástralo donde la mezcla esté en uno de ellos",
    "{bone} is driven by {system} of {other}": "{bone} está movido por {system} de {other}",
    "{bone} of {object} is not being solved: the panel says why":
        "{bone} de {object} no se está resolviendo: el panel dice por qué",
    "Tools": "Herramientas",
    "Look for the frames on which chains do not come to their targets":
        "Busca los fotogramas en que las cadenas no llegan a sus objetivos",
    "{chains} chains reach their targets on all frames {range}":
        "{chains} cadenas alcanzan sus objetivos en todos los fotogramas {range}",
    "Muted chains are not checked": "Las cadenas silenciadas no se comprueban",
    "Reaches its target on all frames {range}": "Alcanza su objetivo en todos los fotogramas {range}",
    "Not solved on {frames}: the panel says why (checked {range})":
        "Sin resolver en {frames}: el panel dice por qué (comprobado {range})",
    "The weights leave it to its animation on all frames {range}":
        "Los pesos la dejan a su animación en todos los fotogramas {range}",
    "Out of reach on {frames}, at most {length} short (checked {range})":
        "Fuera de alcance en {frames}, le faltan como máximo {length} (comprobado {range})",
    "Too near on {frames}, at most {length} (checked {range})":
        "Demasiado cerca en {frames}, como máximo {length} (comprobado {range})",
    "Too far with the target's orientation on {frames}, at most {length} short (checked {range})":
        "Demasiado lejos con la orientación del objetivo en {frames}, le faltan como máximo {length} (comprobado {range})",
    "Something has changed since the last check: check again":
        "Algo ha cambiado desde la última comprobación: comprueba de nuevo",
    "Turned as the target is, the last bone leaves the others too short":
        "Girado como el objetivo, el último hueso deja cortos a los demás",
    "Held by joint limits on {frames}, at most {length} short (checked {range})":
        "Retenida por límites de articulación en {frames}, le faltan como máximo {length} (comprobado {range})",
    "Iterations used up on {frames}, at most {length} short (checked {range})":
        "Iteraciones agotadas en {frames}, le faltan como máximo {length} (comprobado {range})",
    "Nothing": "Nada",
    "Every target is reached": "Se alcanzan todos los objetivos",
    "Too Far": "Demasiado lejos",
    "The target is farther than the chain reaches": "El objetivo está más lejos de lo que alcanza la cadena",
    "Too Near": "Demasiado cerca",
    "The target is nearer than the chain can fold": "El objetivo está más cerca de lo que la cadena puede plegarse",
    "A joint limit is in the way": "Lo impide un límite de articulación",
    "The iterations were used up": "Se agotaron las iteraciones",
    "Not Solved": "Sin resolver",
    "The chain has no target, or cannot be solved": "La cadena no tiene objetivo, o no se puede resolver",
    "Animation": "Animación",
    "The weights leave the chain to its animation": "Los pesos dejan la cadena a su animación",
    "Checked": "Comprobado",
    "Frames that were checked; empty before any check":
        "Fotogramas comprobados; vacío antes de cualquier comprobación",
    "Frames from one that was checked to the next": "Fotogramas de uno comprobado al siguiente",
    "Frames on which the chain does not come to its target, such as 12-40, 77":
        "Fotogramas en que la cadena no llega a su objetivo, como 12-40, 77",
    "Short By": "Falta",
    "The largest distance that is left to the target": "La mayor distancia que queda hasta el objetivo",
    "Reason": "Motivo",
    "Reason on the frame on which the chain falls shortest": "Motivo en el fotograma en que más le falta a la cadena",
}

OPERATORS = {
    "As Bone": "Como hueso",
    "IK with Control Bone": "IK con hueso de control",
    "Make Pole": "Crear polo",
    "New Control Bone": "Nuevo hueso de control",
    "Use Inverse Kinematics Preset": "Usar preajuste de cinemática inversa",
    "Add Inverse Kinematics Preset": "Agregar preajuste de cinemática inversa",
    "Add Target": "Agregar objetivo",
    "IK with Pole": "IK con polo",
    "Inverse Kinematics": "Cinemática inversa",
    "Remove All": "Quitar todo",
    "Remove Inverse Kinematics": "Quitar cinemática inversa",
    "Remove Target": "Quitar objetivo",
    "Check Reach": "Comprobar alcance",
    "Drag Chain": "Arrastrar cadena",
    "Match FK to IK": "Igualar FK a IK",
    "Match IK to FK": "Igualar IK a FK",
    "Switch Target": "Cambiar de objetivo",
}
