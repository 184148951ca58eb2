"""Spanish: chroma keys."""

INTERFACE = {
    "A screen is green or blue: nothing is keyed by this colour": "Una pantalla es verde o azul: con este color no se recorta nada",
    "A screen is green or blue: this colour is {hue}": "Una pantalla es verde o azul: este color es {hue}",
    "Average": "Media",
    "Core Fill": "Rellenar interior",
    "Core Mask": "Máscara de interior",
    "Curves Before": "Curvas anteriores",
    "Despill Limit": "Límite del reflejo",
    "Double": "Doble",
    "Edge": "Borde",
    "Exposure Before": "Exposición anterior",
    "Gamma Before": "Gamma anterior",
    "Gap": "Hueco",
    "Give keys of older versions the present node group, with their settings, and find its levels":
        "Da a los cromas de versiones anteriores el grupo de nodos actual, con sus ajustes, y busca sus niveles",
    "Add a mask or a picture to the key, whose white part becomes transparent or stays opaque":
        "Da al croma una máscara o una imagen cuya parte blanca queda transparente, o se conserva opaca",
    "Share of the light removed by despill that is added again as grey":
        "Cuánta de la luz que se quita con el reflejo vuelve como gris",
    "Index": "Índice",
    "Keep Light": "Conservar luz",
    "Kind": "Tipo",
    "Remove this mask from the key; the mask stays in the file": "El croma deja de tener esta máscara, que se queda en el archivo",
    "Light": "Luz",
    "Make another colour of the footage transparent too, by a key with settings and masks of its own":
        "Vuelve transparente otro color más de la filmación, con un croma que tiene ajustes y máscaras propios",
    "Mask": "Máscara",
    "Maximum": "Máximo",
    "Move the corners of {object} in an Image Editor, in the mode Mask":
        "Mueve las esquinas de {object} en un editor de imágenes, en el modo Máscara",
    "Name a mask or a picture, not both": "Nombra una máscara o una imagen, no las dos",
    "Name of a mask of this file; without it a new one is made, to be drawn on":
        "Nombre de una máscara de este archivo; sin él se hace una nueva, para dibujar en ella",
    "Name of an image, or path of a file, whose white part counts, in place of a mask":
        "Nombre de una imagen, o ruta de un archivo, cuya parte blanca cuenta en lugar de una máscara",
    "Picture": "Imagen",
    "Pictures and Masks": "Imágenes y máscaras",
    "Pictures that are missing in sequences, and the frames in which they are":
        "Imágenes que faltan en las secuencias, y los fotogramas en los que faltan",
    "Screen Gain": "Ganancia de pantalla",
    "Show the settings of this key in the panel": "Muestra los ajustes de este croma",
    "Remove the key that the panel shows; other keys stay": "Quita el croma que muestra el panel; los demás se quedan",
    "The average of the two other channels in which the larger counts twice":
        "La media de los otros dos canales, en la que el mayor cuenta dos veces",
    "The average of the two other channels, which takes most away": "La media de los otros dos canales, que es lo que más quita",
    "The clip or image that lies underneath": "El clip o la imagen que queda debajo",
    "The first key goes with the whole: remove the chroma key": "El primer croma se va con todo: quita el croma",
    "The key is of an older version: upgrade it first": "El croma es de una versión anterior: actualízalo primero",
    "The larger of the two other channels: yellow and cyan stay as they are":
        "El mayor de los otros dos canales: el amarillo y el cian quedan como están",
    "The scene's color management changes the footage's colours: {names}":
        "La gestión de color de la escena cambia los colores de la filmación: {names}",
    "This key is of an older version, and goes on as it was": "Este croma es de una versión anterior, y sigue como era",
    "Level up to which holes well inside the subject are filled; the subject's edge stays soft, and 0 fills no holes":
        "Hasta cuánto se rellenan los huecos del sujeto, bien adentro de su borde, que queda suave; 0 no rellena ninguno",
    "Colour that is keyed; by default that of the next screen that is found in the picture behind the other keys":
        "Lo que se recorta; sin él, la siguiente pantalla que se encuentra en lo que dejan los cromas",
    "Factor on the amount of screen in a pixel: above 1 dark parts of the screen become transparent too":
        "Por cuánto se multiplica la parte de pantalla de un píxel: por encima de 1 también queda transparente una zona oscura de la pantalla",
    "Effect of the mask's white part": "Lo que hace la máscara",
    "What the screen's channel is limited by on the subject": "Lo que limita el canal de la pantalla en el sujeto",
    "Where all is clear: stands, lamps and what lies beyond the screen":
        "Donde todo es transparente: soportes, focos y lo que queda fuera de la pantalla",
    "Where all is opaque: what has the screen's colour within the subject":
        "Donde todo es opaco: lo que tiene el color de la pantalla dentro del sujeto",
    "Index of the key, from 0": "Qué croma, desde 0",
    "Kind of the mask that is removed": "Qué máscara",
    "Index of the key that the panel shows": "Cuál de los cromas muestra el panel",
    "White Balance Before": "Balance de blancos anterior",
    "grey or white": "gris o blanco",
    "magenta": "magenta",
    "red": "rojo",
    "yellow": "amarillo",
    "{object} lacks pictures {numbers}: frames {frames} show the ones before":
        "A {object} le faltan las imágenes {numbers}: los fotogramas {frames} muestran las anteriores",
    "{scene} has a chroma key already: add another color to it, or remove it first":
        "{scene} ya tiene un croma: agrégale otro color, o quítalo primero",
    "Choose one file, or the pictures of one numbered sequence": "Elige un archivo, o las imágenes de una secuencia numerada",
    "Choose the clip or image that lies underneath": "Elige el clip o la imagen que queda debajo",
    "Show the key in the viewport, through the scene's camera; a second time restores the previous view":
        "Mira el croma en la vista, por la cámara de la escena; otra vez para mirar como antes",
    "Another clip or image lies underneath": "Otro clip u otra imagen",
    "Background": "Fondo",
    "Balance": "Equilibrio",
    "Black what is clear, white what is opaque, and all between in grey":
        "Negro lo transparente, blanco lo opaco y gris todo lo intermedio",
    "Chroma Key": "Croma",
    "Camera": "Cámara",
    "Clip": "Clip",
    "Clip Black": "Recortar negro",
    "Clip White": "Recortar blanco",
    "Color Noise": "Ruido de color",
    "Colour of the screen; by default it is found in the footage": "Color de la pantalla; sin él se busca el de la propia filmación",
    "Composite": "Composición",
    "Despill": "Quitar reflejo",
    "Feather": "Suavizar borde",
    "File": "Archivo",
    "Find the colour of the screen, and levels that make it transparent, from the footage again":
        "Vuelve a buscar en la filmación el color de la pantalla y los niveles que la despejan",
    "Footage": "Filmación",
    "Frame Rate Base Before": "Base de fotogramas por segundo anterior",
    "Frame Rate Before": "Fotogramas por segundo anteriores",
    "Frames Before": "Fotogramas anteriores",
    "Distance from the camera to the plane": "Distancia de la cámara al plano",
    "Garbage Mask": "Máscara de descarte",
    "Give the scene the footage's size, frames and frame rate, and colours that leave the footage as it is":
        "Da a la escena el tamaño, los fotogramas y la cadencia de la filmación, y colores que la dejan como es",
    "Grow Matte": "Ensanchar mate",
    "How much of the background's light falls around the subject's edge":
        "Cuánta luz del fondo cae alrededor del borde del sujeto",
    "How much of the screen's light is taken from the subject": "Cuánta luz de la pantalla se quita del sujeto",
    "Key": "Clave",
    "Keep Color": "Conservar color",
    "Level of the matte above which all is opaque": "Nivel del mate por encima del cual todo es opaco",
    "Level of the matte below which all is transparent": "Nivel del mate por debajo del cual todo es transparente",
    "Light Wrap": "Luz envolvente",
    "Light of the screen on the subject, 1 for as much as on the screen itself":
        "Luz de la pantalla sobre el sujeto; 1 es tanta como en la propia pantalla",
    "Look Before": "Aspecto anterior",
    "Make the green or blue screen of a clip or image transparent, and lay something underneath, in the compositor":
        "Vuelve transparente la pantalla verde o azul de un clip o una imagen y pone algo debajo, en el compositor",
    "Matte": "Mate",
    "Name a clip, an image or a file": "Nombra un clip, una imagen o un archivo",
    "Name of a mask, within which all is made transparent": "Nombre de una máscara dentro de la cual todo se vuelve transparente",
    "Name of the camera that the plane stands before; empty takes the scene's":
        "Nombre de la cámara ante la que está el plano; vacío, la de la escena",
    "Name the clip or image that is laid underneath": "Nombra el clip o la imagen que se pone debajo",
    "Node Before": "Nodo anterior",
    "Nothing": "Nada",
    "Find the levels alone, for the colour that was picked": "Solo busca los niveles, para el color elegido",
    "Path of the footage, as the file browser gives it": "Ruta de la filmación, tal como la da el explorador de archivos",
    "Pixel Aspect Before": "Proporción de píxel anterior",
    "Pixels by which the matte grows; below 0 it is choked": "Píxeles que crece el mate; por debajo de 0 se encoge",
    "Pixels over which colour is smoothed before it is keyed, for noise and compressed colour":
        "Píxeles en los que se suaviza el color antes del croma, contra el ruido y el color comprimido",
    "Pixels over which the matte's edge is made soft": "Píxeles en los que se suaviza el borde del mate",
    "Plane": "Plano",
    "Plane Distance": "Distancia del plano",
    "Plane before the camera that shows the key in the viewport": "Plano ante la cámara que muestra el croma en la vista 3D",
    "Render": "Procesamiento",
    "Resolution Before": "Resolución anterior",
    "Scene Set": "Escena ajustada",
    "Screen": "Pantalla",
    "Screen Color": "Color de pantalla",
    "Set Scene": "Ajustar escena",
    "Set Up": "Preparar",
    "Share of the picture that the screen fills": "Parte de la imagen que ocupa la pantalla",
    "Show the key in the viewport too, on a plane that fills the camera's view and is not rendered":
        "Muestra el croma también en la vista 3D, en un plano que llena la vista de la cámara y no se procesa",
    "Smooth Color": "Suavizar color",
    "Socket Before": "Conector anterior",
    "Source": "Origen",
    "Spill": "Reflejo",
    "Spread of the screen's chromaticity": "Dispersión de la cromaticidad de la pantalla",
    "Spread of the screen's luminance, over its median": "Dispersión de la luminancia de la pantalla, entre su mediana",
    "Status": "Estado",
    "Remove the key's nodes and its plane, and restore the compositor and the scene":
        "Quita los nodos del croma y su plano; el compositor y la escena quedan como estaban",
    "The compositor's nodes are linked from another file": "Los nodos del compositor están vinculados desde otro archivo",
    "Nodes Switched On": "Nodos activados",
    "The compositor was switched on for the key": "El compositor se activó para el croma",
    "The compositor's nodes were made for the key": "Los nodos del compositor se hicieron para el croma",
    "The footage as it is": "La filmación tal como es",
    "Footage: name of an image or movie clip of this file, or path of a file":
        "La filmación: nombre de una imagen o un clip de película de este archivo, o ruta de un archivo",
    "The key has lost its footage": "El croma ha perdido su filmación",
    "The picture stays transparent": "La imagen queda transparente",
    "The plane needs a camera to stand before": "El plano necesita una cámara ante la que estar",
    "The scene was given the footage's size, frames and colours":
        "La escena recibió el tamaño, los fotogramas y los colores de la filmación",
    "The screen fills only {percent} % of the picture": "La pantalla ocupa solo el {percent} % de la imagen",
    "The screen is lit unevenly, by {percent} %: raise Clip Black until the status shows it black":
        "La pantalla está iluminada de forma desigual, en un {percent} %: sube «Recortar negro» hasta que el estado la muestre negra",
    "The screen shines on the subject, by {percent} %: lower Clip White until the status shows it white":
        "La pantalla ilumina al sujeto, en un {percent} %: baja «Recortar blanco» hasta que el estado lo muestre blanco",
    "The screen's colour is not the same everywhere: raise Smooth Color":
        "El color de la pantalla no es igual en todas partes: sube «Suavizar color»",
    "The subject over the background": "El sujeto sobre el fondo",
    "There is no clip, no image and no file {object}": "No hay ningún clip, ninguna imagen ni ningún archivo {object}",
    "There is no mask {object}": "No hay ninguna máscara {object}",
    "Tree Made": "Árbol hecho",
    "Underneath": "Debajo",
    "Unevenness": "Desigualdad",
    "View": "Vista",
    "View Transform Before": "Transformación de vista anterior",
    "Viewport Plane": "Plano en la vista",
    "Name of the clip or image, or path of the file, that is laid underneath; empty for the render":
        "Nombre del clip o la imagen, o ruta del archivo, que se pone debajo; vacío, el procesamiento",
    "Picture that shows where the screen was": "Imagen que se ve donde estaba la pantalla",
    "The picture that the compositor showed before the key: the render, with all that its nodes do":
        "La imagen que el compositor mostraba antes del croma: el procesamiento, con todo lo que hacen sus nodos",
    "Picture that the compositor shows": "Imagen que muestra el compositor",
    "Value that the scene had before the key": "Lo que la escena tenía antes del croma",
    "Which of the two other channels the screen's channel is compared with: 0 the larger, 1 the smaller":
        "Con cuál de los otros dos canales se compara el de la pantalla: 0 con el mayor, 1 con el menor",
    "Keyed Pilot": "Piloto con croma",
    "A pilot who was filmed before a green screen stands among columns while his aeroplane passes":
        "Un piloto filmado ante una pantalla verde está entre columnas mientras pasa su avión",
    "White where the subject is opaque, black where it is clear": "Blanco donde el sujeto es opaco, negro donde es transparente",
    "With a background, footage lies underneath": "Con un fondo, lo que hay debajo es filmación",
    "blue": "azul",
    "green": "verde",
    "{object} cannot be read as a picture": "{object} no se puede leer como imagen",
    "{object} has no colours": "{object} no tiene colores",
    "{object} is keyed by its {kind} screen": "{object} tiene croma por su pantalla {kind}",
    "{object} shows no green or blue screen: pick the colour, if there is one":
        "{object} no muestra ninguna pantalla verde ni azul: elige el color, si la hay",
    "{scene} has no chroma key": "{scene} no tiene ningún croma",
    "{scene} is linked from another file": "{scene} está vinculada desde otro archivo",
}

OPERATORS = {
    "Add Mask": "Agregar máscara",
    "Key Another Color": "Agregar otro color",
    "Remove Key of a Color": "Quitar croma de un color",
    "Remove Mask": "Quitar máscara",
    "Show Key": "Mostrar croma",
    "Upgrade Key": "Actualizar croma",
    "Find Levels": "Buscar niveles",
    "Show in Viewport": "Mostrar en la vista",
    "Measure Screen": "Medir pantalla",
    "Remove Chroma Key": "Quitar croma",
    "Set Up Chroma Key": "Preparar croma",
}
"""Operators' names have a context of their own in Blender."""
