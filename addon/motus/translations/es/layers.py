"""Spanish: animation layers."""

INTERFACE = {
    "Animation Layers": "Capas de animación",
    "Override": "Sustituir",
    "The layer takes the place of what lies beneath it": "La capa ocupa el lugar de lo que hay debajo",
    "Additive": "Sumar",
    "The difference between the action and its reference is added to what lies beneath":
        "La diferencia entre la acción y su referencia se suma a lo que hay debajo",
    "First Frame": "Primer fotograma",
    "The action is compared with its own first frame": "La acción se compara con su propio primer fotograma",
    "The action is compared with its pose at a frame of its own":
        "La acción se compara con su pose en uno de sus fotogramas",
    "Rest Pose": "Pose de reposo",
    "The action is compared with the rig's rest pose": "La acción se compara con la pose de reposo del rig",
    "Stop": "Parar",
    "The layer ends with its action": "La capa termina con su acción",
    "Hold": "Mantener",
    "The last pose stays": "La última pose se queda",
    "Repeat": "Repetir",
    "The action begins again; its last frame is its first one":
        "La acción vuelve a empezar; su último fotograma es el primero",
    "A bone": "Un hueso",
    "The bones of a bone collection, or of a bone group before Blender 4":
        "Los huesos de una colección de huesos, o de un grupo de huesos antes de Blender 4",
    "How the layer acts on what lies beneath it": "Cómo actúa la capa sobre lo que hay debajo",
    "How much the layer acts; 0 leaves what lies beneath as it is": "Cuánto actúa la capa; 0 deja lo de debajo como está",
    "Frame of the scene on which the action begins to play. Cannot be keyed: the whole motion follows from it":
        "Fotograma de la escena en el que la acción empieza a reproducirse. No admite claves: todo el movimiento depende de ello",
    "How fast the action plays; a negative speed plays it backwards, from its last frame. Cannot be keyed: the whole motion follows from it":
        "A qué velocidad se reproduce la acción; con una negativa va hacia atrás, desde su último fotograma. No admite claves: todo el movimiento depende de ello",
    "After": "Después",
    "What follows the last frame of the action": "Qué sigue al último fotograma de la acción",
    "Blend In": "Entrada gradual",
    "Number of frames from the start over which the weight grows. Cannot be keyed: the whole motion follows from it":
        "Número de fotogramas desde el inicio en los que crece el peso. No admite claves: todo el movimiento depende de ello",
    "Blend Out": "Salida gradual",
    "Number of frames before the end over which the weight of a layer that stops fades. Cannot be keyed: the whole motion follows from it":
        "Número de fotogramas antes del final en los que se desvanece el peso de una capa que termina. No admite claves: todo el movimiento depende de ello",
    "Reference": "Referencia",
    "Pose that an additive layer is compared with": "Pose con la que se compara una capa que suma",
    "Reference Frame": "Fotograma de referencia",
    "Frame of the action whose pose an additive layer is compared with. Cannot be keyed: the whole motion follows from it":
        "Fotograma de la acción con cuya pose se compara una capa que suma. No admite claves: todo el movimiento depende de ello",
    "Steady in Armature": "Firme en el esqueleto",
    "Blend rotations as they are in the armature, so that hips outside of the mask do not swing the bones in it":
        "Mezclar las rotaciones como están en el esqueleto, para que unas caderas fuera de la máscara no balanceen sus huesos",
    "Number of bones from the border of the mask over which the weight rises. Cannot be keyed: the whole motion follows from it":
        "Número de huesos desde el borde de la máscara en los que crece el peso. No admite claves: todo el movimiento depende de ello",
    "Frame Range": "Rango de fotogramas",
    "Play a part of the action, and not all of its frames": "Reproducir una parte de la acción, y no todos sus fotogramas",
    "First": "Primero",
    "First frame of the part of the action that is played. Cannot be keyed: the whole motion follows from it":
        "Primer fotograma de la parte de la acción que se reproduce. No admite claves: todo el movimiento depende de ello",
    "Last": "Último",
    "Last frame of the part of the action that is played. Cannot be keyed: the whole motion follows from it":
        "Último fotograma de la parte de la acción que se reproduce. No admite claves: todo el movimiento depende de ello",
    "Name of the bone or the collection": "Nombre del hueso o de la colección",
    "Kind": "Clase",
    "Whether the name is that of a bone or of a collection": "Si el nombre es de un hueso o de una colección",
    "With Children": "Con hijos",
    "All bones below count as well": "También cuentan todos los huesos que hay debajo",
    "How much the layer acts on these bones. Cannot be keyed: the whole motion follows from it":
        "Cuánto actúa la capa sobre estos huesos. No admite claves: todo el movimiento depende de ello",
    "Layer": "Capa",
    "Name of the layer": "Nombre de la capa",
    "Action": "Acción",
    "Action that the layer plays": "Acción que reproduce la capa",
    "Slot": "Ranura",
    "Slot of the action, where it has several; empty takes the first one that animates bones of the rig":
        "Ranura de la acción, si tiene varias; vacío toma la primera que anima huesos del rig",
    "Mask": "Máscara",
    "Active Mask": "Máscara activa",
    "Switch the layer off": "Desactivar la capa",
    "How much all layers of the rig act; 0 leaves it to its own animation":
        "Cuánto actúan todas las capas del rig; 0 lo deja a su propia animación",
    "Layers": "Capas",
    "Active Layer": "Capa activa",
    "Timing": "Tiempo",
    "Blending": "Mezcla",
    "Border of the Mask": "Borde de la máscara",
    "The layer acts on all bones: add some to keep it to these":
        "La capa actúa sobre todos los huesos: agrega algunos para que se limite a ellos",
    "Selected Bones": "Huesos seleccionados",
    "The bones that are selected in Pose Mode; all bones of the rig in Object Mode":
        "Los huesos seleccionados en modo Pose; en modo Objeto todos los del rig",
    "Whole Rig": "Todo el rig",
    "All bones of the rig": "Todos los huesos del rig",
    "Name of the layer; empty takes the active one": "Nombre de la capa; vacío toma la activa",
    "Names of bones for the mask, with commas between": "Nombres de huesos para la máscara, separados por comas",
    "Names of bone collections for the mask, with commas between":
        "Nombres de colecciones de huesos para la máscara, separados por comas",
    "Collections": "Colecciones",
    "All bones below those of the mask count as well": "También cuentan todos los huesos bajo los de la máscara",
    "Name of the action; empty leaves it to be chosen": "Nombre de la acción; vacío la deja por elegir",
    "Identifier of the action's slot; empty takes the rig's own or one of its name, else the first one that animates its bones":
        "Identificador de la ranura de la acción; vacío toma la del rig o una de su nombre, si no la primera que anima sus huesos",
    "Frame of the scene on which the action begins to play; not given, the current frame":
        "Fotograma de la escena en el que la acción empieza a reproducirse; si no se da, el fotograma actual",
    "Name of the layer; empty takes the action's. One that is there is changed":
        "Nombre de la capa; vacío toma el de la acción. Una que ya existe se cambia",
    "Bones that the layer acts on if neither bones nor collections are named":
        "Huesos sobre los que actúa la capa si no se nombran huesos ni colecciones",
    "Lay an action over the rig's own animation, on the selected bones and those below, or on all bones":
        "Poner una acción sobre la animación propia del rig, en los huesos seleccionados y los de debajo, o en todos",
    "Remove a layer from the rig; its action stays in the file":
        "Quitar una capa del rig; su acción se queda en el archivo",
    "Move towards the top of the list, beneath the other layer":
        "Mover hacia el principio de la lista, debajo de la otra capa",
    "Move towards the end of the list, above the other layer": "Mover hacia el final de la lista, encima de la otra capa",
    "Exchange a layer with its neighbour: layers further down in the list act on top":
        "Intercambiar una capa con su vecina: las que siguen en la lista actúan encima",
    "Lay a copy of a layer, with the same action and mask, above it":
        "Poner encima de una capa una copia suya, con la misma acción y máscara",
    "Let the active layer act on the selected bones too": "Hacer que la capa activa actúe también sobre los huesos seleccionados",
    "Take a bone or collection out of the layer's mask; without any the layer acts on all bones":
        "Sacar un hueso o una colección de la máscara de la capa; sin ninguno la capa actúa sobre todos los huesos",
    "Index in the mask's list; -1 is the active one": "Índice en la lista de la máscara; -1 es el activo",
    "Write what the layers give into one new action, and mute them; the old action stays in the file":
        "Escribir lo que dan las capas en una sola acción nueva y silenciarlas; la acción anterior se queda en el archivo",
    "Some layers have no action, or one without keys for their bones: the list says which":
        "Algunas capas no tienen acción, o una sin claves para sus huesos: la lista dice cuáles",
    "Drivers of bones or of layers read bones that layers move: layers leave these alone":
        "Controladores de huesos o de capas leen huesos que mueven las capas: las capas los dejan como están",
    "Select the armature that shall have layers": "Selecciona el esqueleto que tendrá capas",
    "Nothing here has layers": "Aquí nada tiene capas",
    "{object} has no layer {layer}": "{object} no tiene la capa {layer}",
    "There is no action {action}": "No existe la acción {action}",
    "There is no slot {slot}": "No existe la ranura {slot}",
    "{object} has no bone collection {collection}": "{object} no tiene la colección de huesos {collection}",
    "{object} has {count} layers already: flatten some first": "{object} ya tiene {count} capas: aplana primero algunas",
    "{layer} of {object} is from its library and stays where it is: mute it":
        "{layer} de {object} es de su biblioteca y se queda donde está: siléncialo",
    "{object} has the layer {layer}": "{object} tiene la capa {layer}",
    "Removed the layer {layer} of {object}": "Se quitó la capa {layer} de {object}",
    "The layer is at the end of the list already": "La capa ya está al final de la lista",
    "Select bones in Pose Mode, or name bones or collections": "Selecciona huesos en modo Pose, o nombra huesos o colecciones",
    "The mask has no such item": "La máscara no tiene ese elemento",
    "No layer moves a bone of {object} that could have keys": "Ninguna capa mueve un hueso de {object} que pueda tener claves",
    "Flattened the layers of {object} into the action {action}: {first}-{last}":
        "Las capas de {object} se aplanaron en la acción {action}: {first}-{last}",
    "Keyframes do not reach bones that have drivers: {bones}": "Las claves no llegan a los huesos con controladores: {bones}",
    "All layers of {object} are muted": "Todas las capas de {object} están silenciadas",
    "Layers pose {bone} above its keys: flatten or mute them first":
        "Las capas dan a {bone} una pose por encima de sus claves: aplánalas o siléncialas primero",
    "Choose an action for this layer": "Elige una acción para esta capa",
    "{object} lacks bones or collections of the mask: {names}":
        "A {object} le faltan huesos o colecciones de la máscara: {names}",
    "Animation Layers Presets": "Preajustes de capas de animación",
    "Gesture": "Gesto",
    "Takes the place of what lies beneath, from its first frame to its last":
        "Ocupa el lugar de lo que hay debajo, del primer fotograma al último",
    "Comes and goes softly, and is held steady over hips that swing":
        "Viene y se va con suavidad, y se mantiene firme sobre caderas que se balancean",
    "Pose to Keep": "Pose que queda",
    "Grows over twelve frames, and the last pose stays": "Crece en doce fotogramas, y la última pose queda",
    "Cycle": "Ciclo",
    "Repeats without an end": "Se repite sin fin",
    "On Top": "Encima",
    "Adds what the action does beyond its first frame, again and again":
        "Suma una y otra vez lo que la acción hace más allá de su primer fotograma",
    "Walk on a Small Planet": "Paseo por un planeta pequeño",
    "A wooden pilot walks on a planet that turns beneath him, and throws an aeroplane and jumps by layers of animation":
        "Un piloto de madera camina sobre un planeta que gira bajo él, y lanza un avión y salta mediante capas de animación",
}

OPERATORS = {
    "Add Layer": "Agregar capa",
    "Remove Layer": "Quitar capa",
    "Move Layer": "Mover capa",
    "Duplicate Layer": "Duplicar capa",
    "Add to Mask": "Agregar a la máscara",
    "Remove from Mask": "Sacar de la máscara",
    "Flatten Layers": "Aplanar capas",
    "Use Animation Layers Preset": "Usar preajuste de capas de animación",
    "Add Animation Layers Preset": "Agregar preajuste de capas de animación",
}
