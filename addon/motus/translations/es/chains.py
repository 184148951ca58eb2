"""Spanish: chains."""

from ...core.settings import NO_KEYS

_NO_KEYS_ES = ". No admite claves: todo el movimiento depende de ello"

INTERFACE = {
    "Windy Bridge": "Puente al viento",
    "A dog whose tail, ears and leash fly in the wind waits at a rope bridge with flags, over which a spider comes": "Un perro cuya cola, orejas y correa ondean al viento espera junto a un puente de cuerdas con banderas, por el que viene una araña",
    "Chain from {name}": "Cadena desde {name}",
    "Chains from {count} Bones": "Cadenas desde {count} huesos",
    "Chains Presets": "Preajustes de cadenas",
    "Chain added from {bone}": "Cadena agregada desde {bone}",
    "{count} chains added": "{count} cadenas agregadas",
    "Wind From": "Viento de",
    "Emitter of snow whose wind, with its gusts, the chains feel beside their own": "Emisor de nieve cuyo viento, con sus ráfagas, sienten las cadenas además del propio",
    "What the wind is taken from emits no snow: choose an emitter": "Aquello de lo que se toma el viento no emite nieve: elige un emisor",
    "{object} has no chains": "{object} no tiene cadenas",
    "Give bones of the other side, found by their names, the settings and pins of the chains of the selected bones, or else of all chains of the rig; chains that are missing there are added": "Da a los huesos del otro lado, hallados por sus nombres, los ajustes y anclajes de las cadenas de los huesos seleccionados o, si no, de todas las del esqueleto; las cadenas que falten allí se agregan",
    "Names of bones whose chains are mirrored, with commas between; empty takes the selected bones, and without any all chains": "Nombres de huesos cuyas cadenas se reflejan, separados por comas; vacío toma los huesos seleccionados y, sin ninguno, todas las cadenas",
    "{bone} hangs as {other} does": "{bone} cuelga como {other}",
    "{count} chains mirrored": "{count} cadenas reflejadas",
    "No bone of {object} is the other side of these chains by its name, as Ear.R is of Ear.L": "Ningún hueso de {object} es por su nombre el otro lado de estas cadenas, como Oreja.R lo es de Oreja.L",
    "Both sides have chains: select bones of the one that the other shall be as": "Ambos lados tienen cadenas: selecciona huesos del que debe servir de modelo al otro",
    "Let the selected bones and all bones below them hang and swing as chains, or points of a curve, or objects in a row on the active one": "Hace que los huesos seleccionados y todos los que hay debajo cuelguen y oscilen como cadenas, o los puntos de una curva, u objetos en fila del activo",
    "Select bones of chains: pins hold these alone": "Selecciona huesos de cadenas: las anclas solo sujetan huesos",
    "Chain along {name}": "Cadena a lo largo de {name}",
    "Hold End": "Sujetar el extremo",
    "Keep the end of the chain where the animation has it, as its beginning"
    + NO_KEYS: "Mantener el extremo de la cadena donde lo tiene la animación, como su principio" + _NO_KEYS_ES,
    "Index of the spline of a curve whose points hang; -1 for all": "Índice del spline de una curva cuyos puntos cuelgan; -1 para todos",
    "Index of the spline of a curve whose points hang; -1 for bones and objects": "Índice del spline de una curva cuyos puntos cuelgan; -1 para huesos y objetos",
    "Spline {number} of {object} is closed: open it first": "El spline {number} de {object} está cerrado: ábrelo primero",
    "{object} has no spline {number} with two points and more": "{object} no tiene un spline {number} con dos puntos o más",
    "Remove chains: in Pose Mode those of the selected bones, else all of the object, or that on which the object hangs": "Quitar cadenas: en modo Pose las de los huesos seleccionados y, si no, todas las del objeto, o aquella de la que cuelga el objeto",
    "Chain of {count} Objects": "Cadena de {count} objetos",
    "How much all chains of the object act; 0 leaves all to its animation": "Cuánto actúan todas las cadenas del objeto; con 0 todo queda en su animación",
    "Name at least two different objects: the one that stays, then those that hang on it, in their order": "Nombra al menos dos objetos distintos: el que se queda y luego los que cuelgan de él, en su orden",
    "Names of objects in a row, with commas between, in place of bones: the one that stays, then those that hang on it": "Nombres de objetos en fila, separados por comas, en lugar de huesos: el que se queda y luego los que cuelgan de él",
    "Object of a row, which hangs on the one before it": "Objeto de una fila, que cuelga del anterior",
    "Select a curve, or objects of a row, first those that hang and last the one that they hang on, or bones in Pose Mode": "Selecciona una curva, o los objetos de una fila, primero los que cuelgan y al final aquel del que cuelgan, o huesos en modo Pose",
    "Some bones or objects of chains are not there any more: remove these from the list": "Algunos huesos u objetos de las cadenas ya no están: quítalas de la lista",
    "Some chains move with what they follow, and are left out": "Algunas cadenas se mueven con lo que siguen y se dejan fuera",
    "What hangs has changed: press Refresh": "Lo que cuelga ha cambiado: pulsa Actualizar",
    "What the chains hang on is in no collection any more: they stay where their own animation has them": "Aquello de lo que cuelgan las cadenas ya no está en ninguna colección: se quedan donde las tiene su propia animación",
    "{object} has no spline {number} with two points and more: remove {chain} from the list": "{object} no tiene un spline {number} con dos puntos o más: quita {chain} de la lista",
    "A pin without a target holds nothing: name one in the part Pins, or remove the pin": "Un ancla sin objetivo no sujeta nada: nombra uno en la parte Anclas, o quita el ancla",
    "The bone that a pin holds to is gone: choose another one in the part Pins, or remove the pin": "El hueso al que sujeta un ancla ya no existe: elige otro en la parte Anclas, o quita el ancla",
    "A pin of a bone that belongs to no chain holds nothing: choose another bone in the part Pins, or remove the pin": "Un ancla de un hueso que no es de ninguna cadena no sujeta nada: elige otro hueso en la parte Anclas, o quita el ancla",
    "{object} is parented to {parent}, which hangs too: clear its parent and keep its transform (Alt P)": "{object} tiene como padre a {parent}, que también cuelga: quítale el padre y conserva su transformación (Alt P)",
    "Names of the topmost bones of the chains, with commas between; empty takes the selected bones": "Nombres de los huesos superiores de las cadenas, separados por comas; vacío toma los huesos seleccionados",
    "Select the topmost bones of the chains": "Selecciona los huesos superiores de las cadenas",
    "Topmost bone of the chain, which has the bones below it, down to where another chain or system begins": "Hueso superior de la cadena, que tiene los huesos que hay debajo, hasta donde empieza otra cadena u otro sistema",
    "Switch this chain off": "Desactivar esta cadena",
    "Blend from the animation (0) to the hanging chain (1)": "Mezcla de la animación (0) a la cadena que cuelga (1)",
    "Swings per second around the animated pose; 0 for a limp chain"
    + NO_KEYS: "Oscilaciones por segundo en torno a la pose animada; 0 para una cadena floja" + _NO_KEYS_ES,
    "Tip Frequency": "Frecuencia de la punta",
    "Frequency of the last bone, as a part of that of the first one" + NO_KEYS: "Frecuencia del último hueso, como parte de la del primero"
    + _NO_KEYS_ES,
    "How much of the scene's gravity pulls the chain" + NO_KEYS: "Cuánta gravedad de la escena tira de la cadena" + _NO_KEYS_ES,
    "How quickly the chain takes on the air's velocity, per second: at 0 it feels neither wind nor still air, at 10 it drifts almost with the air"
    + NO_KEYS: "Con qué rapidez toma la cadena la velocidad del aire, por segundo: con 0 no siente ni viento ni aire quieto, con 10 va casi con el aire"
    + _NO_KEYS_ES,
    "Tip Mass": "Masa de la punta",
    "Tip Shape": "Forma de la punta",
    "Where along the chain it goes over to Tip Frequency, Tip Mass and Tip Thickness: evenly at 1, near its root below 1, near its tip above 1"
    + NO_KEYS: "En qué parte de la cadena se pasa a Frecuencia, Masa y Grosor de la punta: uniformemente con 1, cerca de su raíz por debajo de 1, cerca de su punta por encima de 1"
    + _NO_KEYS_ES,
    "Shape by Curve": "Forma por curva",
    "Draw a curve that says how much of the tip's values is reached along the chain, from its root at the left to its tip, in place of Tip Shape"
    + NO_KEYS: "Dibuja una curva que dice cuánto de los valores de la punta se alcanza a lo largo de la cadena, de su raíz a la izquierda a su punta, en lugar de Forma de la punta"
    + _NO_KEYS_ES,
    "The curve's widget is missing: press Refresh": "Falta el control de la curva: pulsa Actualizar",
    "Tip Thickness": "Grosor de la punta",
    "Thickness of the last bone, as a part of that of the first one" + NO_KEYS: "Grosor del último hueso, como parte del del primero"
    + _NO_KEYS_ES,
    "Mass of the last bone, as a part of that of the first one" + NO_KEYS: "Masa del último hueso, como parte de la del primero"
    + _NO_KEYS_ES,
    "Part of its length by which a bone's own weight would lengthen it; without Squash bones keep their lengths, and point to where longer ones would end"
    + NO_KEYS: "Parte de su longitud en la que alargaría a un hueso su propio peso; sin Aplastar los huesos conservan su longitud y apuntan a donde acabarían los alargados"
    + _NO_KEYS_ES,
    "Squash": "Aplastar",
    "How much bones show that Stretch lengthens and shortens them: they are scaled along their length, up to five times, and across, so that they keep their volume. Bones whose children inherit their scale keep their lengths"
    + NO_KEYS: "Cuánto muestran los huesos que Estirar los alarga y acorta: se escalan a lo largo, hasta cinco veces, y a lo ancho, para conservar su volumen. Los huesos cuyos hijos heredan su escala conservan su longitud"
    + _NO_KEYS_ES,
    "Bones keep their lengths whose children inherit their scale: set Inherit Scale of the children to None": "Conservan su longitud los huesos cuyos hijos heredan su escala: pon Heredar escala de los hijos en Ninguno",
    "{bone} keeps its length, since {child} inherits its scale: set Inherit Scale of {child} to None": "{bone} conserva su longitud, pues {child} hereda su escala: pon Heredar escala de {child} en Ninguno",
    "Scaled": "Escalada",
    "Squash is not 0": "Aplastar no es 0",
    "Bend Limit": "Límite de flexión",
    "Largest angle to where a bone would be if it followed its parent; 180 degrees for no limit"
    + NO_KEYS: "Mayor ángulo respecto a donde estaría un hueso si siguiera a su padre; 180 grados para ningún límite" + _NO_KEYS_ES,
    "Radius of the chain where it touches colliders and other chains"
    + NO_KEYS: "Radio de la cadena donde toca colisionadores y otras cadenas" + _NO_KEYS_ES,
    "Side Limit": "Límite lateral",
    "Largest angle sideways, along a bone's X axis, if that is less than the Bend Limit: such as for an ear, a strip or a finger"
    + NO_KEYS: "Mayor ángulo hacia los lados, a lo largo del eje X de un hueso, si es menor que el límite de flexión: como para una oreja, una tira o un dedo"
    + _NO_KEYS_ES,
    "Touch Each Other": "Tocarse entre sí",
    "Chains that wait for each other, as by a pin or a collider, do not touch each other": "Las cadenas que se esperan una a otra, como por una sujeción o un colisionador, no se tocan entre sí",
    "Keep the chains of this object apart by the thickness of both, as far as they are apart on the scene's first frame"
    + NO_KEYS: "Mantiene separadas las cadenas de este objeto por el grosor de ambas, hasta donde lo están en el primer fotograma de la escena"
    + _NO_KEYS_ES,
    "Velocity of the air, which chains with Air Drag feel": "Velocidad del aire, que notan las cadenas con resistencia del aire",
    "How much the wind rises and falls: 1 lets it fall to a calm at times" + NO_KEYS: "Cuánto sube y baja el viento: con 1 se calma a veces"
    + _NO_KEYS_ES,
    "Approximate number of gusts per second" + NO_KEYS: "Número aproximado de ráfagas por segundo" + _NO_KEYS_ES,
    "Settle": "Asentar",
    "Time, at most, in which chains come to rest in their first pose before the scene begins"
    + NO_KEYS: "Tiempo, como máximo, en el que las cadenas llegan al reposo en su primera pose antes de que empiece la escena"
    + _NO_KEYS_ES,
    "Let the motion close without a seam over the scene's frames, where the animation does"
    + NO_KEYS: "Hace que el movimiento se cierre sin costura en los fotogramas de la escena, si la animación lo hace" + _NO_KEYS_ES,
    "Reset at Cuts": "Reiniciar en los cortes",
    'Start anew at rest at each marker of the scene whose name begins with "cut"'
    + NO_KEYS: 'Empezar de nuevo en reposo en cada marcador de la escena cuyo nombre empiece por "cut"' + _NO_KEYS_ES,
    "Collection with what chains do not enter. An empty displayed as a sphere is a ball, or a capsule if it is scaled unevenly; each other empty is a plane that is solid below its X and Y axes. Deforming bones of armatures are capsules as thick as their envelopes. Meshes that keep their shape are surfaces": "Colección con aquello en lo que las cadenas no entran. Un vacío que se muestra como esfera es una bola, o una cápsula si su escala no es uniforme; cualquier otro vacío es un plano macizo por debajo de sus ejes X e Y. Los huesos deformadores de los esqueletos son cápsulas tan gruesas como sus envolturas. Las mallas que conservan su forma son superficies",
    "How much colliders, and chains that touch, hold back what slides along them"
    + NO_KEYS: "Cuánto frenan los colisionadores, y las cadenas que se tocan, lo que se desliza por ellos" + _NO_KEYS_ES,
    "A mesh that changes its shape is no collider: name its armature, whose bones are capsules, or empties instead": "Una malla que cambia de forma no es un colisionador: usa su esqueleto, cuyos huesos son cápsulas, o vacíos",
    "A mesh has too many triangles to be a collider: give it a modifier Decimate, or take a simpler one": "Una malla tiene demasiados triángulos para ser un colisionador: dale un modificador Diezmar o usa una más simple",
    "Hold the tails of the selected bones of chains, or else the end of the shown chain, to an object": "Sujeta a un objeto las colas de los huesos seleccionados de cadenas y, si no, el extremo de la cadena mostrada",
    "Remove pins of chains: of the selected bones in Pose Mode, else all of the rig; an empty that was made for a pin goes along": "Quitar anclas de cadenas: las de los huesos seleccionados en modo Pose y, si no, todas las del rig; el vacío que se creó para un ancla desaparece con ella",
    "Names of the bones whose tails are held, with commas between; empty takes the selected bones, and without any the last bone of the shown chain": "Nombres de los huesos cuyas colas se sujetan, separados por comas; vacío toma los huesos seleccionados y, sin ninguno, el último hueso de la cadena mostrada",
    "Names of the bones whose pins are removed, with commas between; empty takes the selected ones, and without any all": "Nombres de los huesos cuyas anclas se quitan, separados por comas; vacío toma los seleccionados y, sin ninguno, todos",
    "Name of the object that holds; empty makes an empty at each bone's tail": "Nombre del objeto que sujeta; sin nombre crea un vacío en la cola de cada hueso",
    "Name of a bone of the target, whose head holds": "Nombre de un hueso del objetivo, cuya cabeza sujeta",
    "How fast the pins hold": "Con qué firmeza sujetan las anclas",
    "Index of the one pin that is removed": "Índice de la única ancla que se quita",
    "Bone of a chain whose tail is held": "Hueso de una cadena cuya cola se sujeta",
    "Object that holds the bone's tail, at its origin": "Objeto que sujeta la cola del hueso, en su origen",
    "Bone of the target whose head holds; empty takes the target's origin": "Hueso del objetivo cuya cabeza sujeta; vacío toma el origen del objetivo",
    "1 holds the bone fast, 0 not at all; between them a spring draws it to the target, softly where the weight is small": "1 sujeta el hueso firmemente, 0 nada; entre ellos un resorte lo lleva al objetivo, con suavidad donde el peso es pequeño",
    "Switch this pin off" + NO_KEYS: "Desactivar esta ancla" + _NO_KEYS_ES,
    "The motion of what holds a pin is not known on other frames: the pin does not hold": "El movimiento de lo que sujeta un ancla no se conoce en otros fotogramas: el ancla no sujeta",
    "The weight of a pin is not known on other frames: the pin does not hold": "El peso de un ancla no se conoce en otros fotogramas: el ancla no sujeta",
    "{bone} is pinned to {target}": "{bone} está anclado a {target}",
    "{count} bones are pinned": "{count} huesos están anclados",
    "{bone} belongs to no chain": "{bone} no pertenece a ninguna cadena",
    "Draw the bend limits of the shown chain as cones": "Dibuja como conos los límites de flexión de la cadena mostrada",
    "Draw the balls, capsules and planes that the chains touch, and where they touch": "Dibuja las bolas, cápsulas y planos que tocan las cadenas, y dónde los tocan",
    "Draw what holds the pinned bones": "Dibuja lo que sujeta los huesos anclados",
    "Inherit Motion": "Heredar movimiento",
    "How much of the motion of the object itself the chains feel: at 0 they come along as if it stood still, such as in a car"
    + NO_KEYS: "Cuánto notan las cadenas del movimiento del propio objeto: con 0 van con él como si estuviera quieto, por ejemplo en un coche"
    + _NO_KEYS_ES,
    "Surroundings": "Entorno",
    "A chain does not come back to where its loop began": "Una cadena no vuelve adonde empezó su bucle",
    "Bones or objects of a chain have constraints of their own, which the chain does not follow, and which may undo its motion": "Huesos u objetos de una cadena tienen restricciones propias, que la cadena no sigue y que pueden anular su movimiento",
    "The motion of a collider is not known on other frames: chains pass through it": "El movimiento de un colisionador no se conoce en otros fotogramas: las cadenas lo atraviesan",
    "The scene's gravity is not known on other frames: chains move without it": "La gravedad de la escena no se conoce en otros fotogramas: las cadenas se mueven sin ella",
    "The wind is not known on other frames: chains move without it": "El viento no se conoce en otros fotogramas: las cadenas se mueven sin él",
    "The scene is too long for so many chains, which come to a stop before its end: split it, or mute some": "La escena es demasiado larga para tantas cadenas, que se detienen antes del final: divídela o silencia algunas",
    "Dog's Tail": "Cola de perro",
    "Stiff at its root, loose at its tip": "Rígida en la raíz, suelta en la punta",
    "Motion Solved": "Movimiento resuelto",
    "Ponytail": "Coleta",
    "Hangs, with a little of its shape": "Cuelga y conserva un poco de su forma",
    "Rope": "Cuerda",
    "Limp: hangs by its weight alone": "Floja: cuelga solo por su peso",
    "Antenna": "Antena",
    "Springs back, and trembles for long": "Vuelve de golpe y tiembla mucho tiempo",
    "Cape Strip": "Tira de capa",
    "Hangs, and is carried by the air": "Cuelga y el aire se la lleva",
    "Earring": "Pendiente",
    "Limp, with a heavy end": "Floja, con el extremo pesado",
    "Tentacle": "Tentáculo",
    "Follows slowly, as in water": "Sigue despacio, como en el agua",
    "Jelly": "Gelatina",
    "Single bones that bounce in place and keep their volume: bellies, cheeks, slime": "Huesos sueltos que rebotan en su sitio y conservan su volumen: barrigas, mejillas, babosas",
}

OPERATORS = {
    "Mirror Chains": "Reflejar cadenas",
    "Add Chains": "Agregar cadenas",
    "Remove Chains": "Quitar cadenas",
    "Pin Chain": "Anclar cadena",
    "Unpin Chain": "Desanclar cadena",
    "Use Chains Preset": "Usar preajuste de cadenas",
    "Add Chains Preset": "Agregar preajuste de cadenas",
}
