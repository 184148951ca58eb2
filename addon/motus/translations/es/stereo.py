"""Spanish: stereo cameras."""

INTERFACE = {
    "Make a camera at the viewport's view if the scene has none": "Crea una cámara donde mira la vista 3D si la escena no tiene ninguna",
    "New Camera": "Cámara nueva",
    "Both eyes are written as: {format}": "Ambos ojos se escriben así: {format}",
    "Show the images of both eyes in the viewport, for red and cyan glasses; a second time restores the previous view":
        "Mira por ambos ojos de la cámara en la vista, con gafas rojas y cian; otra vez para mirar como antes",
    "Set the parallax of the budget to a comfortable one for this screen, with no more depth than looks natural":
        "Fija el paralaje del presupuesto en lo que es cómodo en esta pantalla, y no más profundo que redondo",
    "The budget strains the eyes: on this screen {near} % in front and {far} % behind are comfortable":
        "El presupuesto cansa la vista: en esta pantalla son cómodos {near} % delante y {far} % detrás",
    "There is no 3D viewport here": "Aquí no hay ninguna vista 3D",
    "14 cm wide, seen from 30 cm": "14 cm de ancho, vista desde 30 cm",
    "60 cm wide, seen from 70 cm": "60 cm de ancho, vista desde 70 cm",
    "1.2 m wide, seen from 2.5 m": "1,2 m de ancho, vista desde 2,5 m",
    "12 m wide, seen from 15 m": "12 m de ancho, vista desde 15 m",
    "18 m wide, seen from 9 m": "18 m de ancho, vista desde 9 m",
    "360 Degrees": "360 grados",
    "A camera cannot be its own focus": "Una cámara no puede ser su propio foco",
    "The screen is at a distance along the camera's axis": "La pantalla está a una distancia según el eje de la cámara",
    "A file for each eye": "Un archivo por ojo",
    "All is well on a {width} m screen": "Todo está bien en una pantalla de {width} m",
    "Anaglyph": "Anaglifo",
    "Largest parallax behind the screen, in percent of the image's width":
        "Mayor paralaje detrás de la pantalla, en porcentaje del ancho de la imagen",
    "Distance between the eyes of the audience, in metres": "Distancia entre los ojos del público, en metros",
    "Distance between the camera's eyes, in the scene's units":
        "Distancia entre los ojos de la cámara, en las unidades de la escena",
    "Both eyes in one image, the left eye's on the left": "Ambos ojos en una imagen, el izquierdo a la izquierda",
    "Both eyes in one image, one above the other": "Ambos ojos en una imagen, uno sobre el otro",
    "Squeeze both images together into the size of one": "Las dos imágenes juntas miden lo que una",
    "Both eyes on top of each other, for red and cyan glasses": "Ambos ojos superpuestos, para gafas rojas y cian",
    "Least number of samples by which near and far change ahead of their cause":
        "Número de muestras en que cerca y lejos cambian antes de su causa, como mínimo",
    "Choose the object that lies on the screen": "Elige el objeto que queda en la pantalla",
    "Cinema": "Cine",
    "Safe from": "Seguro desde",
    "Safe to": "Seguro hasta",
    "Convergence": "Convergencia",
    "Convergence and interocular distance follow from the depths of the scene and the parallax that they may have":
        "La convergencia y la distancia interocular resultan de las profundidades de la escena y del paralaje que pueden tener",
    "Convergence mode that the camera had without the rig": "Modo de convergencia que la cámara tenía sin el montaje",
    "Corners are higher in one eye than in the other by more than a pixel, {pixels} pixels, in {frames}":
        "Las esquinas están más altas en un ojo que en el otro por más de un píxel, {pixels} píxeles, en {frames}",
    "Depth Budget": "Presupuesto de profundidad",
    "A camera that sees all around has no budget of depth: choose another convergence first":
        "Una cámara que ve todo alrededor no tiene presupuesto de profundidad: elige antes otra convergencia",
    "Depth of the farthest thing that counts for the budget": "Profundidad de lo más lejano que cuenta para el presupuesto",
    "Depth of the nearest thing that counts for the budget": "Profundidad de lo más cercano que cuenta para el presupuesto",
    "Diverges on a {width} m screen by {percent} % in {frames}":
        "Diverge en una pantalla de {width} m por {percent} % en {frames}",
    "Dome": "Cúpula",
    "Eye Separation": "Separación de los ojos",
    "Far": "Lejos",
    "Far Parallax": "Paralaje lejano",
    "Focal length and sensor must be greater than 0": "La distancia focal y el sensor deben ser mayores que 0",
    "Focus": "Foco",
    "Format": "Formato",
    "Distance from the audience to a custom screen, in metres":
        "Distancia del público a una pantalla personalizada, en metros",
    "Distance from the camera to the screen": "Distancia de la cámara a la pantalla",
    "Give a camera a left and a right eye, whose distances are set for an audience in front of a screen":
        "Da a una cámara un ojo izquierdo y uno derecho, con distancias pensadas para un público ante una pantalla",
    "How much the rig sets the camera's eyes; 0 leaves them at the camera's own values":
        "Cuánto fija el montaje los ojos de la cámara; con 0 quedan en los valores de la propia cámara",
    "How the images are written": "Cómo se escriben las imágenes",
    "How the images meet on the screen": "Cómo se encuentran las imágenes en la pantalla",
    "Largest parallax in front of the screen, in percent of the image's width":
        "Mayor paralaje delante de la pantalla, en porcentaje del ancho de la imagen",
    "Interlaced": "Entrelazado",
    "Interocular": "Interocular",
    "Is too far behind a {width} m screen by {percent} % in {frames}":
        "Queda demasiado detrás de una pantalla de {width} m por {percent} % en {frames}",
    "Is too far in front of a {width} m screen by {percent} % in {frames}":
        "Queda demasiado delante de una pantalla de {width} m por {percent} % en {frames}",
    "Left Out": "Excluido",
    "Make the camera a panorama of 360 degrees, if the render engine can; by default the camera's type is kept":
        "Deja que la cámara vea todo alrededor, si el motor de procesamiento puede. Si no se indica, sigue viendo lo mismo",
    "Look Ahead": "Anticipación",
    "Look for the frames on which the audience's eyes would have to turn apart, or something is cut off in one of them. If markers "
    "choose the scene's cameras, the camera of each frame is checked":
        "Busca los fotogramas en que los ojos del público tendrían que separarse, o algo queda cortado en uno de ellos. Si los "
        "marcadores eligen las cámaras de la escena, se comprueba la cámara de cada fotograma",
    "Monitor": "Monitor",
    "Multiview Made": "Multivista activada",
    "Name of the camera; empty takes the active one, or the scene's":
        "Nombre de la cámara; vacío toma la activa, o la de la escena",
    "Name of the object that lies on the screen; if Convergence is Object, empty takes the object that is selected beside the camera":
        "Nombre del objeto que queda en la pantalla; vacío toma el seleccionado además de la cámara, si la convergencia es de un objeto",
    "Near": "Cerca",
    "Near Parallax": "Paralaje cercano",
    "Near and far parallax are both 0: there is no depth to spend":
        "Los paralajes cercano y lejano son 0: no hay profundidad que repartir",
    "Draw the planes of the depth budget: near in red, the screen in white, far in blue":
        "Dibujar los planos del presupuesto de profundidad: cerca en rojo, la pantalla en blanco, lejos en azul",
    "Near must be greater than 0, and far greater than near": "Cerca debe ser mayor que 0, y lejos mayor que cerca",
    "Width of a custom screen, in metres": "Ancho de una pantalla personalizada, en metros",
    "Draw marks where parallax is a multiple of half a percent, and lines to the selected objects: green, strained ones in yellow, diverging ones in pink":
        "Dibujar marcas donde el paralaje es múltiplo de medio por ciento, y líneas a los objetos seleccionados: verdes; amarillas si fuerzan la vista; rosas si divergen",
    "Off-Axis": "Descentrado",
    "Only Cycles can see all around in stereo: choose that as the render engine first":
        "Solo Cycles ve todo alrededor en estéreo: elígelo antes como motor de procesamiento",
    "Pair": "Par",
    "Measured Parallax": "Paralaje medido",
    "Parallel": "Paralelo",
    "Phone": "Teléfono",
    "Pivot Before": "Pivote anterior",
    "Pivot that the camera had without the rig": "Pivote que la cámara tenía sin el montaje",
    "Planes": "Planos",
    "Panorama Before": "Panorama anterior",
    "Kind of panorama that the camera had before it was made to see all around":
        "Clase de panorama que la cámara tenía antes de hacerla ver todo alrededor",
    "Spherical Before": "Esférico anterior",
    "Whether the camera's stereo was spherical before it was made to see all around":
        "Si el estéreo de la cámara era esférico antes de hacerla ver todo alrededor",
    "Mode Before": "Modo anterior",
    "Roundness": "Redondez",
    "Ruler": "Regla",
    "Safe Volume": "Volumen seguro",
    "Screen": "Pantalla",
    "Screen Width": "Ancho de pantalla",
    "Seen From": "Vista desde",
    "Select a camera, or give the scene one": "Selecciona una cámara, o dale una a la escena",
    "Select the object that lies on the screen beside the camera, or name it":
        "Selecciona, además de la cámara, el objeto que queda en la pantalla, o nómbralo",
    "Set how the images of both eyes are written": "Fija cómo se escriben las imágenes de ambos ojos",
    "Set near and far of the depth budget to what the camera sees; over several frames as keys":
        "Ajusta cerca y lejos del presupuesto de profundidad a lo que la cámara ve; en varios fotogramas, como claves",
    "Share of the picture that does not count at either end: small things that are very near or very far":
        "Parte de la imagen que no cuenta en cada extremo: cosas pequeñas muy cercanas o muy lejanas",
    "Side by Side": "Lado a lado",
    "Squeezed": "Comprimido",
    "Stereo Camera": "Cámara estéreo",
    "Stereo Colonnade": "Columnata estéreo",
    "An aeroplane between columns at several depths, filmed by a stereo camera that looks after it":
        "Un avión entre columnas a varias profundidades, filmado por una cámara estéreo que lo sigue con la mirada",
    "Stereo Presets": "Preajustes de estéreo",
    "Remove the stereo rig, and restore the camera": "Retira el montaje: la cámara es la que era antes",
    "Television": "Televisor",
    "The camera sees nothing that has a depth": "La cámara no ve nada que tenga profundidad",
    "The camera sees nothing that has a depth in {frames}":
        "La cámara no ve nada que tenga profundidad en {frames}",
    "The camera's pivot is not the centre: one eye stands where the camera does":
        "El pivote de la cámara no es el centro: un ojo está donde la cámara",
    "The convergence distance must be greater than 0": "La distancia de convergencia debe ser mayor que 0",
    "The eyes are turned towards each other, which moves corners up and down":
        "Los ojos se giran el uno hacia el otro, lo que mueve las esquinas arriba y abajo",
    "The eyes look the same way, and their images are shifted":
        "Los ojos miran en la misma dirección y sus imágenes se desplazan",
    "The eyes look the same way: all is in front of the screen":
        "Los ojos miran en la misma dirección: todo queda delante de la pantalla",
    "The scene does not render a left and a right eye: Stereo Output lets it":
        "La escena no procesa un ojo izquierdo y uno derecho: Salida estéreo lo permite",
    "Views Before": "Vistas anteriores",
    "Format of views that the scene had before a rig switched multiview on":
        "Formato de vistas que la escena tenía antes de que el montaje activara la multivista",
    "A rig has switched multiview on in the scene": "Un montaje activó la multivista en la escena",
    "The rig needs a perspective camera: with this one the camera's own values count":
        "El montaje necesita una cámara en perspectiva: con esta cuentan los valores de la propia cámara",
    "The rows of one image belong to the left and the right eye in turns": "Las filas de una imagen, por turnos",
    "The window is violated on the left edge by {percent} % in {frames}":
        "La ventana se viola en el borde izquierdo por {percent} % en {frames}",
    "The window is violated on the right edge by {percent} % in {frames}":
        "La ventana se viola en el borde derecho por {percent} % en {frames}",
    "Toe-In": "Convergente",
    "Top-Bottom": "Arriba y abajo",
    "Type Before": "Tipo anterior",
    "Type that the camera had before it was made to see all around":
        "Tipo que la cámara tenía antes de hacerla ver todo alrededor",
    "Draw the volume that an audience can look at without strain":
        "Dibujar el volumen que un público puede mirar sin esfuerzo",
    "What sets the convergence distance, at which things are neither in front of the screen nor behind it":
        "Cómo se halla la distancia a la que las cosas no quedan ni delante ni detrás de la pantalla",
    "Object that lies on the screen, if Convergence is Object":
        "Objeto que queda en la pantalla, si Convergencia es Objeto",
    "The object that shall lie on the screen is at the camera or behind it":
        "El objeto que debe quedar en la pantalla está en la cámara o detrás de ella",
    "Screen that the audience looks at; warnings are about this screen":
        "Pantalla que mira el público, a la que se refieren los avisos",
    "The screen is where an object is along the camera's axis":
        "La pantalla está donde está un objeto según el eje de la cámara",
    "Custom width and viewing distance": "Ancho y distancia de visión personalizados",
    "{object} has a stereo rig": "{object} tiene un montaje estéreo",
    "{object} has a stereo rig: remove that first": "{object} tiene un montaje estéreo: quítalo antes",
    "{object} has its lens in common with {other}, which has a stereo rig":
        "{object} comparte su lente con {other}, que tiene un montaje estéreo",
    "{object} has no stereo rig": "{object} no tiene montaje estéreo",
    "{object} is no camera": "{object} no es una cámara",
    "{object} is no perspective camera": "{object} no es una cámara en perspectiva",
}

OPERATORS = {
    "Anaglyph View": "Vista anaglifo",
    "Fit to Screen": "Ajustar a la pantalla",
    "Add Stereo Rig": "Agregar montaje estéreo",
    "Add Stereo Preset": "Agregar preajuste de estéreo",
    "Check Stereo": "Comprobar estéreo",
    "Measure Depth": "Medir profundidad",
    "Remove Stereo Rig": "Quitar montaje estéreo",
    "Stereo Output": "Salida estéreo",
}
