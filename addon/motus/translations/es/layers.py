"""Spanish: animation layers."""

INTERFACE = {
    "Animation Layers": "Capas de animación",
    "Override": "Sustituir",
    "The layer takes the place of what lies beneath it": "La capa ocupa el lugar de lo que hay debajo",
    "Additive": "Sumar",
    "What the action does beyond its reference comes on top of what lies beneath":
        "Lo que la acción hace más allá de su referencia se pone encima de lo que hay debajo",
    "First Frame": "Primer fotograma",
    "What the action does beyond its own first frame counts": "Cuenta lo que la acción hace más allá de su primer fotograma",
    "What it does beyond the pose of a frame of the action counts":
        "Cuenta lo que hace más allá de la pose de un fotograma de la acción",
    "Rest Pose": "Pose de reposo",
    "The whole pose of the action counts": "Cuenta toda la pose de la acción",
    "Stop": "Terminar",
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
    "How much of the layer there is; 0 leaves what lies beneath as it is":
        "Cuánto hay de la capa; 0 deja lo de debajo como está",
    "Frame of the scene on which the action begins to play. No keys: the whole motion follows from it":
        "Fotograma de la escena en el que la acción empieza a reproducirse. Sin claves: de él sale todo el movimiento",
    "How fast the action plays; below 0 backwards, from its last frame. No keys: the whole motion follows from it":
        "A qué velocidad se reproduce la acción; por debajo de 0 hacia atrás, desde su último fotograma. Sin claves: de ella sale "
        "todo el movimiento",
    "After": "Después",
    "What follows the last frame of the action": "Qué sigue al último fotograma de la acción",
    "Blend In": "Entrada gradual",
    "Frames from the start on, over which the weight grows. No keys: the whole motion follows from it":
        "Fotogramas desde el inicio en los que crece el peso. Sin claves: de ellos sale todo el movimiento",
    "Blend Out": "Salida gradual",
    "Frames before the end, over which the weight fades; of a layer that stops. No keys: the whole motion follows from it":
        "Fotogramas antes del final en los que se desvanece el peso, en una capa que termina. Sin claves: de ellos sale todo el "
        "movimiento",
    "Reference": "Referencia",
    "What an additive layer is compared with": "Con qué se compara una capa que suma",
    "Reference Frame": "Fotograma de referencia",
    "Frame of the action whose pose does nothing. No keys: the whole motion follows from it":
        "Fotograma de la acción cuya pose no hace nada. Sin claves: de él sale todo el movimiento",
    "Steady in Armature": "Firme en el esqueleto",
    "Blend rotations as they are in the armature, so that hips outside of the mask do not swing the bones in it":
        "Mezclar las rotaciones como están en el esqueleto, para que unas caderas fuera de la máscara no balanceen sus huesos",
    "Over how many bones from the border of the mask on the weight rises. No keys: the whole motion follows from it":
        "En cuántos huesos desde el borde de la máscara crece el peso. Sin claves: de él sale todo el movimiento",
    "Frame Range": "Rango de fotogramas",
    "Play a part of the action, and not all of its frames": "Reproducir una parte de la acción, y no todos sus fotogramas",
    "First": "Primero",
    "Frame of the action that the part begins with. No keys: the whole motion follows from it":
        "Fotograma de la acción con el que empieza la parte. Sin claves: de él sale todo el movimiento",
    "Last": "Último",
    "Frame of the action that the part ends with. No keys: the whole motion follows from it":
        "Fotograma de la acción con el que acaba la parte. Sin claves: de él sale todo el movimiento",
    "Name of the bone or the collection": "Nombre del hueso o de la colección",
    "Kind": "Clase",
    "What the name is of": "De qué es el nombre",
    "With Children": "Con hijos",
    "All bones below count as well": "También cuentan todos los huesos que hay debajo",
    "How much of the layer these bones take. No keys: the whole motion follows from it":
        "Cuánto toman estos huesos de la capa. Sin claves: de él sale todo el movimiento",
    "Layer": "Capa",
    "Name of the layer": "Nombre de la capa",
    "Action": "Acción",
    "What the layer plays": "Lo que reproduce la capa",
    "Slot": "Ranura",
    "Slot of the action, where it has several; empty takes the first one of an object":
        "Ranura de la acción, si tiene varias; vacío toma la primera de un objeto",
    "Mask": "Máscara",
    "Active Mask": "Máscara activa",
    "Leave out this layer": "Dejar fuera esta capa",
    "How much all layers of the rig act; 0 leaves it to its own animation":
        "Cuánto actúan todas las capas del rig; 0 lo deja a su propia animación",
    "Layers": "Capas",
    "Active Layer": "Capa activa",
    "Timing": "Tiempo",
    "Blending": "Mezcla",
    "Border of the Mask": "Borde de la máscara",
    "The layer acts on all bones: add some to keep it to these":
        "La capa actúa sobre todos los huesos: añada algunos para que se limite a ellos",
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
    "Identifier of the action's slot; empty takes the rig's own, else the first one of an object":
        "Identificador de la ranura de la acción; vacío toma la del rig, si no la primera de un objeto",
    "Name of the layer; empty takes the action's. One that is there is changed":
        "Nombre de la capa; vacío toma el de la acción. Una que ya existe se cambia",
    "On which bones the layer acts, where neither bones nor collections are named":
        "Sobre qué huesos actúa la capa, si no se nombran huesos ni colecciones",
    "Lay an action over the rig's own animation, on the selected bones and those below, or on all bones":
        "Poner una acción sobre la animación propia del rig, en los huesos seleccionados y los de debajo, o en todos",
    "Take a layer off the rig; its action stays in the file": "Quitar una capa del rig; su acción se queda en el archivo",
    "Wire the rig again, after its bones or bone collections were changed":
        "Volver a conectar el rig después de cambiar sus huesos o sus colecciones de huesos",
    "Towards the top of the list, beneath the other layer": "Hacia el principio de la lista, debajo de la otra capa",
    "Towards the end of the list, above the other layer": "Hacia el final de la lista, encima de la otra capa",
    "Let a layer change places with its neighbour: those further down in the list lie above":
        "Hacer que una capa cambie de lugar con su vecina: las que siguen en la lista están encima",
    "Lay a copy of a layer, with the same action and mask, above it":
        "Poner encima de una capa una copia suya, con la misma acción y máscara",
    "Let the active layer act on the selected bones too": "Hacer que la capa activa actúe también sobre los huesos seleccionados",
    "Take a bone or collection out of the layer's mask; without any the layer acts on all bones":
        "Sacar un hueso o una colección de la máscara de la capa; sin ninguno la capa actúa sobre todos los huesos",
    "Which of the mask's list; -1 is the active one": "Cuál de la lista de la máscara; -1 es el activo",
    "Write what the layers give into one new action, and mute them; the old action stays in the file":
        "Escribir lo que dan las capas en una sola acción nueva y silenciarlas; la acción anterior se queda en el archivo",
    "Some layers have no action, or one without keys for their bones: the list says which":
        "Algunas capas no tienen acción, o una sin claves para sus huesos: la lista dice cuáles",
    "Drivers of bones or of layers read bones that layers move: layers leave these alone":
        "Controladores de huesos o de capas leen huesos que mueven las capas: las capas los dejan como están",
    "Select the armature that shall have layers": "Seleccione el esqueleto que tendrá capas",
    "Nothing here has layers": "Aquí nada tiene capas",
    "{object} has no layer {layer}": "{object} no tiene la capa {layer}",
    "There is no action {action}": "No existe la acción {action}",
    "There is no slot {slot}": "No existe la ranura {slot}",
    "{object} has no bone collection {collection}": "{object} no tiene la colección de huesos {collection}",
    "{object} has {count} layers already: flatten some first": "{object} ya tiene {count} capas: aplane primero algunas",
    "{layer} of {object} is from its library and stays where it is: mute it":
        "{layer} de {object} es de su biblioteca y se queda donde está: siléncielo",
    "{object} has the layer {layer}": "{object} tiene la capa {layer}",
    "Removed the layer {layer} of {object}": "Se quitó la capa {layer} de {object}",
    "The layer is at the end of the list already": "La capa ya está al final de la lista",
    "Select bones in Pose Mode, or name bones or collections": "Seleccione huesos en modo Pose, o nombre huesos o colecciones",
    "The mask has no such item": "La máscara no tiene ese elemento",
    "No layer moves a bone of {object} that could have keys": "Ninguna capa mueve un hueso de {object} que pueda tener claves",
    "Flattened the layers of {object} into the action {action}: {first}-{last}":
        "Las capas de {object} se aplanaron en la acción {action}: {first}-{last}",
    "Keyframes do not reach bones that have drivers: {bones}": "Las claves no llegan a los huesos con controladores: {bones}",
    "All layers of {object} are muted": "Todas las capas de {object} están silenciadas",
    "Layers pose {bone} above its keys: flatten or mute them first":
        "Las capas dan a {bone} una pose por encima de sus claves: aplánelas o siléncielas primero",
    "Choose an action for this layer": "Elija una acción para esta capa",
    "{object} has not what the mask names: {names}": "{object} no tiene lo que nombra la máscara: {names}",
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
    "Add Layer": "Añadir capa",
    "Remove Layer": "Quitar capa",
    "Move Layer": "Mover capa",
    "Duplicate Layer": "Duplicar capa",
    "Add to Mask": "Añadir a la máscara",
    "Remove from Mask": "Sacar de la máscara",
    "Flatten Layers": "Aplanar capas",
    "Use Animation Layers Preset": "Usar preajuste de capas de animación",
    "Add Animation Layers Preset": "Añadir preajuste de capas de animación",
}
