"""Spanish: what all systems share, Follow Path and the demos."""

INTERFACE = {
    "{bone} would be driven from {first} and from {second}": "{bone} estaría movido desde {first} y desde {second}",
    "Give the settings of the active bone to all selected bones that have the same system, in Object Mode to all selected objects":
        "Dar los ajustes del hueso activo a todos los huesos seleccionados que tienen el mismo sistema; en modo Objeto, a todos los objetos seleccionados",
    "Name of the object; empty takes the active one, and the selected bones or objects":
        "Nombre del objeto; vacío toma el activo, y los huesos u objetos seleccionados",
    "Name of the system whose settings are copied, such as dynamics": "Nombre del sistema cuyos ajustes se copian, como dynamics",
    "Name of the bone whose settings are copied; empty takes the active one": "Nombre del hueso cuyos ajustes se copian; vacío toma el activo",
    "Names of the bones that are given the settings, with commas between; empty takes the selected ones":
        "Nombres de los huesos que reciben los ajustes, separados por comas; vacío toma los seleccionados",
    "Select what shall be given these settings too": "Selecciona lo que ha de recibir también estos ajustes",
    "Nothing else that is selected has {system}": "Nada más de lo seleccionado tiene {system}",
    "Nothing here has {system}": "Nada aquí tiene {system}",
    "Settings copied to 1 other": "Ajustes copiados a 1 más",
    "Settings copied to {count} others": "Ajustes copiados a {count} más",
    "Chosen Entry": "Entrada elegida",
    "Build an example of a system in a new scene and show it; your own scenes stay as they are":
        "Crea un ejemplo de un sistema en una escena nueva y lo muestra; las escenas propias quedan como están",
    "Demo Scene": "Escena de demostración",
    "X, Y or Z locks an axis, Shift is precise, a number sets the length; Esc or the right button cancels":
        "X, Y o Z fija un eje, Mayús da precisión, un número da la longitud; Esc o el botón derecho cancela",
    "Aircraft": "Avión",
    "Even speed, and the bank that an aircraft needs in its curves": "Velocidad constante y el alabeo que piden sus curvas",
    "Bird": "Pájaro",
    "Leans gently, and its body trails behind the turn": "Se inclina un poco y su cuerpo gira con retraso",
    "Car": "Coche",
    "Starts and stops gently, upright": "Arranca y para con suavidad, derecho",
    "Roller Coaster": "Montaña rusa",
    "Up points to the middle of each bend, also in loopings": "Arriba apunta al centro de cada curva, también en los rizos",
    "Camera Move": "Movimiento de cámara",
    "Soft at both ends, never rolling": "Suave en ambos extremos, sin girar sobre sí",
    "Bead on a String": "Cuenta en un hilo",
    "Turned as little as possible along the path": "Gira lo menos posible por el camino",
    "Preset": "Preajuste",
    "Preset that gives the settings their values": "Preajuste que da sus valores a los ajustes",
    "Give the settings the values of a preset that comes with Motus":
        "Dar a los ajustes los valores de un preajuste que trae Motus",
    "There are no settings here for this preset": "Aquí no hay ajustes para este preajuste",
    # Machinery
    "Active": "Activo",
    "This system drives the object": "Este sistema mueve el objeto",
    "Baked": "Capturado",
    "The motion stands in keyframes and the live set-up is switched off":
        "El movimiento está en fotogramas clave y el montaje en vivo está desactivado",
    "Hub": "Núcleo",
    "Hidden object that computes for all members": "Objeto oculto que calcula para todos los miembros",
    "Order Proxy": "Testigo de orden",
    "Hidden object that lets the curve's deformation be evaluated first":
        "Objeto oculto que hace evaluar antes la deformación de la curva",
    "Leader": "Guía",
    "Object whose settings drive this one": "Objeto cuyos ajustes mueven este",
    "Copy the message to the clipboard": "Copiar el mensaje al portapapeles",
    "Nothing is selected": "No hay nada seleccionado",
    "Motus could not compute this: see the system console": "Motus no pudo calcular esto: consulta la consola del sistema",
    "The data of this system in the file is damaged: press Refresh, or set it up again":
        "Los datos de este sistema en el archivo están dañados: pulsa Actualizar, o configúralo de nuevo",
    "There are more points than there is room for: only the first ones are shown":
        "Hay más puntos que sitio para ellos: solo se ven los primeros",
    "Made by a newer version of Motus, whose data this one cannot read: update Motus, or press Refresh":
        "Creado por una versión más nueva de Motus, cuyos datos esta no puede leer: actualiza Motus, o pulsa Actualizar",
    "Not evaluated: the add-on's driver functions are not available in this file yet":
        "Sin evaluar: las funciones de los controladores del complemento aún no están disponibles en este archivo",
    "This copy of Motus is built for Python {pythons}, but this Blender runs Python {python}: install a Motus release that contains it":
        "Esta copia de Motus está hecha para Python {pythons}, pero este Blender usa Python {python}: instala una versión de Motus que lo incluya",
    "The native module could not be loaded ({error}): reinstall Motus, and report this line if that does not help":
        "No se pudo cargar el módulo nativo ({error}): vuelve a instalar Motus y, si no ayuda, comunica esta línea",
    "The native module is version {found} but the add-on is {wanted}: restart Blender, and reinstall Motus if that does not help":
        "El módulo nativo es de la versión {found}, pero el complemento es de la {wanted}: reinicia Blender y, si no ayuda, vuelve a instalar Motus",
    "A Bézier curve of more than 65 control points is not supported":
        "No se admite una curva de Bézier de más de 65 puntos de control",
    "NURBS splines of an order above 6 cannot be followed: lower the order":
        "No se pueden seguir splines NURBS de orden superior a 6: reduce el orden",
    "Native module {found}": "Módulo nativo {found}",
    "While Influence is 1, keys and drivers of what the path sets have no effect: animate a child of this object":
        "Mientras Influencia sea 1, las claves y los controladores de lo que fija la trayectoria no tienen efecto: anima un hijo de este objeto",
    "Winter Flight": "Vuelo de invierno",
    "Eight systems at once: a pilot walks through the snow, throws an aeroplane and steers it, while lanterns swing and a spider comes to see":
        "Ocho sistemas a la vez: un piloto camina por la nieve, lanza un avión y lo dirige, mientras oscilan unos "
        "faroles y una araña viene a ver",
    "The demo scene could not be finished: {error}": "No se pudo terminar la escena de demostración: {error}",
    "Built {scene}": "Se creó {scene}",
    "The native module is missing from this copy of Motus: remove the add-on and install it from a release zip":
        "A esta copia de Motus le falta el módulo nativo: quita el complemento e instálalo desde un zip publicado",
    "{object} is linked from another file: make a library override of it first":
        "{object} está vinculado desde otro archivo: crea antes una redefinición de biblioteca",
    "{bone} of {object} is from its library and cannot be removed here: mute it":
        "{bone} de {object} viene de su biblioteca y no se puede quitar aquí: siléncialo",
    "A pin of {object} is from its library and cannot be removed here: mute it":
        "Un alfiler de {object} viene de su biblioteca y no se puede quitar aquí: siléncialo",
    "Released": "Liberado",
    "What the library has wired on this override was taken off it":
        "Lo que la biblioteca había conectado en esta redefinición se ha quitado de ella",
    "The wagons of {object} are from its library and cannot be uncoupled here: remove the train":
        "Los vagones de {object} vienen de su biblioteca y no se pueden desenganchar aquí: quita el tren",
    "This target is from the library of {object} and cannot be removed here":
        "Este objetivo viene de la biblioteca de {object} y no se puede quitar aquí",

    # Viewport
    "Overlay": "Superposición",
    "Show": "Mostrar",
    "Show what the systems compute in the viewport": "Mostrar en la vista lo que calculan los sistemas",
    "Curve": "Curva",
    "Draw the curve that is followed": "Dibujar la curva que se sigue",
    "Control Points": "Puntos de control",
    "Draw the control polygon": "Dibujar el polígono de control",
    "Tangents": "Tangentes",
    "Draw the tangent at equal distances": "Dibujar la tangente a distancias iguales",
    "Frames": "Fotogramas",
    "frame {frames}": "el fotograma {frames}",
    "frames {frames}": "los fotogramas {frames}",
    "Path Frames": "Orientaciones",
    "Offset": "Desplazamiento",
    "Draw the orientation at equal distances": "Dibujar la orientación a distancias iguales",
    "Speed": "Velocidad",
    "Colour the curve by the follower's speed": "Colorear la curva según la velocidad de quien la sigue",

    # Baking
    "Turn what Motus computes into keyframes, in an action of their own":
        "Convertir lo que calcula Motus en fotogramas clave, en una acción propia",
    "Take the baked keyframes away, put the object's own action back and switch the systems on again":
        "Quitar los fotogramas clave capturados, devolver al objeto su propia acción y reactivar los sistemas",
    "Object": "Objeto",
    "Object that is driven or drives others; empty means the active one":
        "Objeto movido, o que mueve a otros; vacío significa el activo",
    "Object that was baked; empty means the active one": "Objeto que se capturó; vacío significa el activo",
    "System": "Sistema",
    "Name of the system to rebuild; empty means all of the object's":
        "Nombre del sistema que reconstruir; vacío significa todos los del objeto",
    "Rebuild what Motus has set up, after bones, parents or data that it reads have changed":
        "Reconstruir lo que Motus ha preparado, después de cambiar huesos, padres o datos que lee",
    "Name of the system to bake; empty means all of the object's":
        "Nombre del sistema que se captura; vacío significa todos los del objeto",
    "Name of a system that was baked; empty means any": "Nombre de un sistema que se capturó; vacío significa cualquiera",
    "Start": "Inicio",
    "First frame; the scene's where it is not given": "Primer fotograma; el de la escena si no se indica",
    "End": "Fin",
    "Last frame; the scene's where it is not given": "Último fotograma; el de la escena si no se indica",
    "Step": "Paso",
    "Frames that are gone through": "Fotogramas que se recorren",
    "Start to End": "De inicio a fin",
    "The frames that are given, or else the scene's": "Los fotogramas que se indiquen o, si no, los de la escena",
    "Preview Range": "Rango de previsualización",
    "The scene's preview range; all frames of the scene where there is none":
        "El rango de previsualización de la escena; todos los fotogramas de la escena si no lo hay",
    "Scene": "Escena",
    "All frames of the scene": "Todos los fotogramas de la escena",
    "Current Frame": "Fotograma actual",
    "The frame that is shown": "El fotograma que se ve",
    "Frames {first}-{last}": "Fotogramas {first}-{last}",
    "Baked {first}-{last}": "Capturado {first}-{last}",
    "First frame of the baked keyframes": "Primer fotograma de las claves capturadas",
    "Last frame of the baked keyframes; as the first one in files of older versions":
        "Último fotograma de las claves capturadas; igual que el primero en archivos de versiones anteriores",
    "More": "Más",
    "Add": "Agregar",
    "Draw what this system computes for the selected objects":
        "Dibujar lo que este sistema calcula para los objetos seleccionados",
    "Path": "Trayectoria",
    "Vertices": "Vértices",
    "Owner": "Dueño",
    "The object moves by baked keyframes": "El objeto se mueve por fotogramas clave capturados",
    "Object whose system was baked; empty where it is this one": "Objeto cuyo sistema se capturó; vacío si es este mismo",
    "Baked Action": "Acción capturada",
    "Action that holds the baked keyframes": "Acción que contiene los fotogramas clave capturados",
    "Previous Action": "Acción anterior",
    "The object's own action, which unbaking puts back": "La acción propia del objeto, que vuelve al deshacer la captura",
    "Previous Slot": "Ranura anterior",
    "The object's slot in its own action": "La ranura del objeto en su propia acción",
    "Kept": "Conservado",
    "Values and switches as they were before baking": "Valores e interruptores tal como estaban antes de capturar",
    "Baked {objects}, {frames}: {first}-{last}": "Captura de {objects}, {frames}: {first}-{last}",
    "1 object": "1 objeto",
    "{count} objects": "{count} objetos",
    "1 frame": "1 fotograma",
    "{count} frames": "{count} fotogramas",
    "Unbaked {objects}": "Deshecha la captura de {objects}",
    "Not all that these were before baking is in the file any more: {objects}":
        "El archivo ya no contiene todo lo que estos eran antes de la captura: {objects}",
    "Step {done} of {all} (Esc cancels)": "Paso {done} de {all} (Esc cancela)",
    "Cancelled: nothing has changed": "Cancelado: no ha cambiado nada",
    "The viewport was closed": "Se ha cerrado la vista 3D",
    "Select an object, or name one": "Selecciona un objeto o indica su nombre",
    "There is no object {object} in the scene": "No hay ningún objeto {object} en la escena",
    "The range is empty: the end frame comes before the start frame":
        "El intervalo está vacío: el último fotograma va antes que el primero",
    "The system drives nothing that could be baked": "El sistema no mueve nada que se pueda capturar",
    "{bone} is connected to its parent, so keyframes cannot move it: disconnect it first":
        "{bone} está conectado a su superior, así que los fotogramas clave no pueden moverlo: desconéctalo antes",
    "{object} is baked already: unbake it first": "{object} ya está capturado: deshaz antes su captura",
    "{object} is in the tweak mode of the NLA editor: leave it first":
        "{object} está en el modo de ajuste del editor de ANL: sal antes de él",
    "{object} is not baked": "{object} no está capturado",
    "{object} is not driven by Motus: add a system to it first": "Motus no mueve {object}: agrégale antes un sistema",
    "{object} is not evaluated: show it in the viewport first": "{object} no se evalúa: muéstralo antes en la vista",
    "{object} is in Rest Position: switch to Pose Position first":
        "{object} está en posición de reposo: cambia antes a la posición de pose",

    # Follow Path: settings
    "Follow Path": "Seguir trayectoria",
    "Influence": "Influencia",
    "How much the path moves the object; 0 leaves it at its own transform":
        "Cuánto mueve la trayectoria al objeto; 0 lo deja en su propia transformación",
    "Curve to follow": "Curva que se sigue",
    "Spline": "Spline",
    "Index of the curve's spline; -1 follows all of them, one after another":
        "Índice del spline de la curva; -1 los sigue todos, uno tras otro",
    "Timing": "Tiempo",
    "What sets the position at a time": "Qué determina la posición en cada momento",
    "Duration": "Duración",
    "The whole path takes a given time": "La trayectoria entera dura un tiempo dado",
    "Time for the whole path": "Tiempo para la trayectoria entera",
    "Distance per second; negative goes backwards": "Distancia por segundo; negativa va hacia atrás",
    "The object goes at a speed, which may be keyed": "El objeto va a una velocidad, que admite claves",
    "Pins": "Anclas",
    "Pins say where the object is at given frames": "Las anclas dicen dónde está el objeto en fotogramas dados",
    "Manual": "Manual",
    "The distance is keyed or driven as a fraction of the path":
        "La distancia se anima o se controla como fracción de la trayectoria",
    "Fraction": "Fracción",
    "Fraction of the path's length": "Fracción de la longitud de la trayectoria",
    "Fraction of the path's length at which the object is":
        "Fracción de la longitud de la trayectoria en la que está el objeto",
    "Frame at which the motion starts": "Fotograma en el que empieza el movimiento",
    "Distance ahead along the path": "Distancia de adelanto a lo largo de la trayectoria",
    "Ease In": "Entrada suave",
    "Fraction of the time that is used to gain speed": "Fracción del tiempo que se emplea en ganar velocidad",
    "Ease Out": "Salida suave",
    "Fraction of the time that is used to lose speed": "Fracción del tiempo que se emplea en perder velocidad",
    "Ends": "Extremos",
    "What happens beyond the ends of the path; if it is not given, a closed path loops and a train lines up":
        "Qué ocurre más allá de los extremos de la trayectoria; si no se indica, una trayectoria cerrada es un bucle y un tren se pone en fila",
    "Line Up": "En fila",
    "The leader of a train stops at the ends; the wagons stand in line behind it, also before the start of the path":
        "El primero para en los extremos; los demás están en fila detrás de él, antes del inicio si hace falta",
    "Gap of All": "Separación de todos",
    "Distance along the path from each wagon to the object in front, the same for all wagons":
        "Distancia en la trayectoria de cada uno al que va delante, igual para todos los vagones",
    "Distance along the path to the object in front; 0 takes the lengths of the objects":
        "Distancia en la trayectoria al que va delante; 0 toma las longitudes de los objetos",
    "Exchange a wagon with the wagon in front of it or behind it; the gaps stay where they are":
        "Cambiar un vagón de lugar con el de delante o el de detrás; las separaciones se quedan donde están",
    "The wagon is at the end of the train already": "El vagón ya está en el extremo del tren",
    "Set each gap so that the wagon touches the object in front of it": "Ajustar cada separación para que el vagón toque al de delante",
    "Select an object that follows this curve": "Seleccionar un objeto que sigue esta curva",
    "Name of the follower; empty takes the first one of the active curve":
        "Nombre del seguidor; vacío toma el primero de la curva activa",
    "Nothing follows this curve": "Nada sigue esta curva",
    "Followed by": "La siguen",
    "and {count} more": "y {count} más",
    "Mode": "Modo",
    "What happens beyond the ends of the path": "Qué ocurre más allá de los extremos de la trayectoria",
    "Stop": "Parar",
    "Stay at the end of the path": "Quedarse en el extremo de la trayectoria",
    "Go On": "Seguir recto",
    "Go on along the tangent of the path's end": "Continuar por la tangente del extremo de la trayectoria",
    "Loop": "Bucle",
    "Begin again at the start of the path": "Volver a empezar desde el principio",
    "Ping-Pong": "Ida y vuelta",
    "Go back and forth along the path": "Ir y volver",

    # Follow Path: orientation
    "Orientation": "Orientación",
    "Direction in which the object's up axis points": "Dirección en la que apunta el eje superior del objeto",
    "None": "Ninguna",
    "Keep the object's own rotation": "Conservar la rotación propia del objeto",
    "World Up": "Vertical del mundo",
    "Up is as near to the world's Z axis as the path allows":
        "Arriba queda tan cerca del eje Z del mundo como permite la trayectoria",
    "Minimal Twist": "Giro mínimo",
    "Never turn about the direction of travel": "No girar nunca en torno a la dirección de avance",
    "Banking": "Peralte",
    "Lean into the bends like an aircraft, by speed and curvature":
        "Inclinarse en las curvas como un avión, según la velocidad y la curvatura",
    "Curvature": "Curvatura",
    "Up points to the centre of the bend, as in a loop": "Arriba apunta al centro de la curva, como en un rizo",
    "Curve Tilt": "Inclinación de la curva",
    "Up is turned by the tilt of the curve's points": "Arriba gira con la inclinación de los puntos de la curva",
    "Forward": "Adelante",
    "Axis of the object that points along the path": "Eje del objeto que apunta a lo largo de la trayectoria",
    "Up": "Arriba",
    "Axis of the object that points up": "Eje del objeto que apunta hacia arriba",
    "Strength": "Intensidad",
    "Factor on the bank: 1 is that of an aircraft, and negative leans outward":
        "Factor del alabeo: 1 es el de un avión, y negativo inclina hacia fuera",
    "Limit": "Límite",
    "Largest roll; 180 degrees is no limit": "Alabeo máximo; 180 grados equivale a no limitar",
    "Smoothing": "Suavizado",
    "Length of path over which the bend is averaged": "Longitud de trayectoria sobre la que se promedia la curvatura",
    "Gravity": "Gravedad",
    "Acceleration that the bank is measured against": "Aceleración con la que se mide el peralte",
    "Outward": "Hacia fuera",
    "Up points away from the centre of the bend": "Arriba apunta en dirección contraria al centro de la curva",
    "Lag": "Retraso",
    "Rate, per second and unit of curvature, at which the orientation trails behind; 0 is exact":
        "Ritmo, por segundo y unidad de curvatura, con el que la orientación va detrás; 0 es exacto",
    "Lag By": "Retraso según",
    "What the rate of the lag is proportional to": "A qué es proporcional el ritmo del retraso",
    "Turns lag by the curvature, which depends on the shape of the curve alone":
        "Los giros se retrasan según la curvatura, que depende solo de la forma de la curva",
    "Acceleration": "Aceleración",
    "Turns lag more on large curves and long handles; Curvature depends on the shape alone":
        "Los giros se retrasan más en curvas grandes y con asas largas; Curvatura depende solo de la forma",

    # Follow Path: pins and trains
    "Pins By": "Anclas por",
    "What the pins give": "Qué indican las anclas",
    "Distance": "Distancia",
    "Distance from the start of the path": "Distancia desde el inicio de la trayectoria",
    "Pins give a distance from the start of the path": "Las anclas indican una distancia desde el inicio de la trayectoria",
    "Pins give a fraction of the path's length": "Las anclas indican una fracción de la longitud de la trayectoria",
    "Frame": "Fotograma",
    "Frame at which the object is at the pin's place": "Fotograma en el que el objeto está en el lugar del ancla",
    "Active Pin": "Ancla activa",
    "Add a pin: a frame and the place to be at": "Agregar un ancla: un fotograma y el lugar donde estar",
    "Add a pin, which puts the object at a place of the path at a frame; by default at its present place and frame":
        "Agregar un alfiler, que pone el objeto en un lugar de la trayectoria en un fotograma; por defecto, en su lugar y fotograma actuales",
    "Remove a pin of the path": "Quitar un ancla de la trayectoria",
    "Index of the pin; -1 is the active one": "Índice del ancla; -1 es la activa",
    "There is no such pin": "No existe esa ancla",
    "Two pins are on the same frame: the later one in the list counts":
        "Hay dos anclas en el mismo fotograma: cuenta la que está más abajo en la lista",
    "Replaced the pin at frame {frame}": "Se ha sustituido el ancla del fotograma {frame}",
    "Train": "Tren",
    "Wagon": "Vagón",
    "Wagons": "Vagones",
    "Active Wagon": "Vagón activo",
    "Object that is this wagon of the train": "Objeto que es este vagón del tren",
    "Gap": "Separación",
    "Distance along the path to the object in front": "Distancia a lo largo de la trayectoria hasta el de delante",
    "Distance along the path from each object to the next; 0 takes the lengths of the objects":
        "Distancia a lo largo de la trayectoria de uno al siguiente; 0 toma la longitud de los objetos",
    "Couple the other selected objects to the end of the train":
        "Enganchar los demás objetos seleccionados al final del tren",
    "Take a wagon out of the train; the wagons behind it keep their places":
        "Sacar un vagón del tren; los de detrás conservan su lugar",
    "Select the object whose settings drive this one": "Seleccionar el objeto cuyos ajustes mueven este",
    "Select the leader of the train, whose settings drive this wagon":
        "Seleccionar el guía del tren, cuyos ajustes controlan este vagón",
    "Name of the leader; empty takes the active one": "Nombre del guía; vacío toma el activo",
    "Name of the wagon; empty takes the other selected objects":
        "Nombre del vagón; vacío toma los demás objetos seleccionados",
    "Index of the wagon; -1 is the active one": "Índice del vagón; -1 es el activo",
    "There is no such wagon": "No existe ese vagón",
    "Select the objects to couple, and the leader last": "Selecciona los objetos que se enganchan y, al final, el guía",
    "A train needs two objects at least": "Un tren necesita al menos dos objetos",
    "An object can be in the train only once": "Un objeto solo puede estar una vez en el tren",
    "Driven by": "Movido por",
    "A copy of a wagon: it stands where the wagon stands": "Copia de un vagón: está donde está el vagón",
    "The leader of this wagon is gone": "El guía de este vagón ya no existe",

    # Follow Path: operators
    "Let the selected objects follow a curve": "Hacer que los objetos seleccionados sigan una curva",
    "Let the selected objects follow a curve as a train, the active object first":
        "Hacer que los objetos seleccionados sigan una curva uno tras otro, el activo primero",
    "Remove Follow Path, so that the objects stand at their own transforms again":
        "Quitar Seguir trayectoria, de modo que los objetos vuelven a sus propias transformaciones",
    "Add a curve whose points, or placed objects, are the control points of one Bézier curve":
        "Agregar una curva cuyos puntos, u objetos colocados, son los puntos de control de una sola curva Bézier",
    "Degree": "Grado",
    "Degree of the curve: one less than the number of its control points": "Uno menos que el número de puntos de control",
    "Name": "Nombre",
    "Name of the new curve": "Nombre de la curva nueva",
    "Name of the object; empty takes the active one": "Nombre del objeto; vacío toma el activo",
    "Name of the object; empty takes the selected ones": "Nombre del objeto; vacío toma los seleccionados",
    "Name of the curve object; empty takes the selected curve": "Nombre del objeto curva; vacío toma el seleccionado",
    "Name of the curve object; empty takes the selected curve, or the curve that the active object follows":
        "Nombre del objeto curva; vacío toma el seleccionado o la que sigue el objeto activo",
    "Objects": "Objetos",
    "Names of objects with commas between, or a collection's name; empty takes the selected objects":
        "Nombres separados por comas, o el nombre de una colección; vacío toma los seleccionados",
    "Names of objects with commas between, or a collection's name: the objects' places are the control points, and moving an object moves the curve":
        "Nombres separados por comas, o el nombre de una colección: sus posiciones son los puntos de control, y mover uno mueve la curva",
    "Show the path from the top, the front and the side at once, without perspective; a second time restores the previous view":
        "Mostrar la trayectoria desde arriba, de frente y de lado a la vez, sin perspectiva; la segunda vez restaura la vista anterior",
    "Views from the top, the front and the right, beside the viewport's present view":
        "Vistas desde arriba, de frente y desde la derecha, junto a la propia de la ventana",
    "Blender runs without a window: choose a single view": "Blender se ejecuta sin ventana: elige una sola vista",
    "Edit Views of {curve}": "Vistas de edición de {curve}",
    "View": "Vista",
    "Edit view that is shown": "Vista de edición que se muestra",
    "The system to show": "El sistema que se muestra",
    "Next": "Siguiente",
    "View from the side if the view from the top is shown, otherwise view from the top":
        "Vista de lado si se muestra la de arriba; si no, vista desde arriba",
    "Top": "Arriba",
    "View from above": "Vista desde arriba",
    "Side": "Lado",
    "View from the side": "Vista de lado",
    "Leave": "Salir",
    "Restore the view that the viewport had before": "Restaurar la vista que tenía la ventana antes",
    "Index": "Índice",
    "Follow Path Presets": "Preajustes de seguir trayectoria",
    "Keep these settings as a preset, or remove it": "Guardar estos ajustes como preajuste, o quitarlo",
    "Name of the preset, used to make the path name": "Nombre del preajuste, del que sale el nombre del archivo",

    # Follow Path: what it reports
    "{object} follows {curve}": "{object} sigue {curve}",
    "{count} objects follow {curve}": "{count} objetos siguen {curve}",
    "{curve} has degree {degree}": "{curve} tiene grado {degree}",
    "Removed from {objects}": "Quitado de {objects}",
    "Nothing here follows a path": "Aquí nada sigue una trayectoria",
    "Nothing here is a wagon of a train": "Aquí nada es un vagón de un tren",
    "Go to Object Mode first": "Pasa antes al modo Objeto",
    "Select the object that shall follow": "Selecciona el objeto que ha de seguir la curva",
    "Choose a curve to follow": "Elige la curva que se sigue",
    "There is no object {object}": "No hay ningún objeto {object}",
    "{object} is not a curve": "{object} no es una curva",
    "{object} is not in this view layer": "{object} no está en esta capa de visualización",
    "{object} cannot follow itself": "{object} no puede seguirse a sí mismo",
    "{curve} is moved by {object}, so {object} cannot follow it": "{object} mueve {curve}, así que {object} no puede seguirla",
    "{object} is a wagon of {leader}: remove it from the train first":
        "{object} es un vagón de {leader}: sácalo antes del tren",
    "{object} is baked: unbake it first": "{object} está capturado: deshaz antes su captura",
    "{object} follows a path of its own: remove that first": "{object} sigue su propia trayectoria: quítasela antes",
    "A Bézier curve needs 2 to {most} control points, not {count}":
        "Una curva Bézier necesita de 2 a {most} puntos de control, no {count}",
    "The curve is in no collection any more: choose another one": "La curva ya no está en ninguna colección: elige otra",
    "The curve has no splines": "La curva no tiene splines",
    "The curve has no spline of this index": "La curva no tiene ningún spline con este índice",
    "A spline needs two points at least": "Un spline necesita al menos dos puntos",
    "NURBS splines with different weights cannot be followed: make the weights equal":
        "No se pueden seguir splines NURBS con pesos distintos: iguala los pesos",
    "The forward axis and the up axis must be perpendicular to each other":
        "El eje de avance y el eje vertical han de ser perpendiculares",
    "The speed is driven, so its past is not known: its present value counts for the whole way":
        "La velocidad viene de un controlador, así que su pasado no se conoce: su valor actual cuenta para todo el recorrido",
    "The speed is animated in NLA strips, so its past is not known: its present value counts for the whole way":
        "La velocidad se anima en tiras de ANL, así que su pasado no se conoce: su valor actual cuenta para todo el recorrido",
    "The fraction is animated in NLA strips, so the speed is not known: banking and lag take it for 0":
        "La fracción se anima en tiras de ANL, así que la velocidad no se conoce: el peralte y el retraso la toman por 0",
    "A setting is not a finite number": "Un ajuste no es un número finito",
    "{keyword} is not a finite number": "{keyword} no es un número finito",
    "ease_in and ease_out are together more than 1": "ease_in y ease_out suman más de 1",

    # Demo scenes
    "A window is needed to show the new scene": "Hace falta una ventana para mostrar la escena nueva",
    "Banked Flight": "Vuelo peraltado",
    "An aeroplane on a curved course over a lake, with a chasing camera":
        "Un avión en un recorrido curvo sobre un lago, con una cámara que lo persigue",
}

OWN_SENSE = {
    "Look At": "Mirar a",
    "Offset": "Desfase",
    "Spline": "Spline",
    "Weight": "Peso",
}

OPERATORS = {
    "To All Selected": "A selección",
    "Add": "Agregar",
    "Use Follow Path Preset": "Usar preajuste de seguir trayectoria",
    "Add Follow Path Preset": "Agregar preajuste de seguir trayectoria",
    "Add Pin": "Agregar ancla",
    "Add Wagons": "Agregar vagones",
    "Add to the Train": "Agregar al tren",
    "Bake": "Capturar",
    "Bézier of Any Degree": "Bézier de cualquier grado",
    "Copy": "Copiar",
    "Demo Scene": "Escena de demostración",
    "Edit Views": "Vistas de edición",
    "Leave Edit Views": "Salir de las vistas de edición",
    "Follow Path": "Seguir trayectoria",
    "Follow Path as a Train": "Seguir trayectoria en tren",
    "Path Edit Views": "Vistas de edición de la trayectoria",
    "Refresh": "Actualizar",
    "Remove": "Quitar",
    "Remove Follow Path": "Quitar seguir trayectoria",
    "Remove Pin": "Quitar ancla",
    "Remove Wagon": "Quitar vagón",
    "Select Leader": "Seleccionar guía",
    "Gaps from Sizes": "Separaciones según los tamaños",
    "Move Wagon": "Mover vagón",
    "Select Follower": "Seleccionar seguidor",
    "Take Out": "Sacar",
    "Unbake": "Deshacer captura",
}
