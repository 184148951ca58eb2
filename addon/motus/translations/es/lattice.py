"""Spanish: lattices."""

INTERFACE = {
    "Parent to Object": "Emparentar al objeto",
    "The lattice's axes are those of the active object": "Los ejes de la jaula son los del objeto activo",
    "The lattice's axes are those of the world": "Los ejes de la jaula son los del mundo",
    "Apply": "Aplicar",
    "Axes of the lattice across whose middle the pull is repeated":
        "Ejes de la jaula a través de cuyo centro se repite el tirón",
    "Cardinal": "Cardinal",
    "Catmull-Rom": "Catmull-Rom",
    "BSpline": "BSpline",
    "Deform only the vertices of the vertex group of this name":
        "Deforma solo los vértices del grupo de vértices de este nombre",
    "Fit": "Ajustada",
    "Fitted": "Ajustada",
    "Global": "Global",
    "Go to Object Mode, or to Edit Mode of a mesh": "Pasa al modo Objeto, o al modo Edición de una malla",
    "Held": "Retenidos",
    "Displacement of the vertex, in the world": "Desplazamiento del vértice, en el mundo",
    "The lattice is turned so that it becomes smallest": "La jaula se gira de modo que quede más pequeña",
    "Index of the pulled vertex, on the object with all its modifiers":
        "Índice del vértice del que se tira, del objeto con todos sus modificadores",
    "Indices, with commas between, of vertices that stay where they are":
        "Índices, separados por comas, de los vértices que se quedan donde están",
    "Keep the deformation when the lattice is removed": "Conserva la deformación",
    "Lattice": "Jaula",
    "Lay a lattice around the selected objects, or the selected vertices in Edit Mode, and let it deform them; the meshes themselves are not changed":
        "Pone una jaula alrededor de los objetos seleccionados, o de los vértices seleccionados en el modo Edición, y deja que los deforme; lo modelado queda intacto",
    "Leave Edit Mode of {object} first": "Sal antes del modo Edición de {object}",
    "Margin": "Margen",
    "Modifier": "Modificador",
    "Motus Lattice": "Jaula de Motus",
    "Motus has made this lattice, and removes it with its last modifier":
        "Motus ha hecho esta jaula, y la quita con su último modificador",
    "Name of the lattice's modifier; empty takes all lattice modifiers that Motus has added":
        "Nombre del modificador de la jaula; vacío toma todos los que Motus ha agregado",
    "Name of the lattice's modifier; empty takes the last lattice modifier": "Nombre del modificador de la jaula; vacío toma el último",
    "Name of the lattice; empty takes the active one": "Nombre de la jaula; vacío toma la activa",
    "Name of the object that the lattice deforms; empty takes the active one, or those of the active lattice":
        "Nombre del objeto que la jaula deforma; vacío toma el activo, o los de la jaula activa",
    "Names of the objects with commas between, or a collection's name; empty takes the selected objects":
        "Nombres de los objetos separados por comas, o de una colección; vacío toma los seleccionados",
    "Nothing here has a lattice that Motus has fitted": "Nada aquí tiene una jaula que Motus haya ajustado",
    "Other modifiers give {object} another number of vertices when {modifier} deforms it: switch them off first":
        "Otros modificadores dan a {object} otro número de vértices cuando {modifier} lo deforma: desactívalos antes",
    "Place in the world; the vertex nearest to it is pulled if no vertex is given":
        "Lugar del mundo de cuyo vértice más cercano se tira, si no se nombra un vértice",
    "Points of the lattice along its three axes": "Puntos de la jaula en sus tres ejes",
    "Press the left mouse button on the surface and drag it; X, Y, Z: mirror ({axes}); Esc or the right "
    "button cancels":
        "Pulsa el botón izquierdo sobre la superficie y arrástrala; X, Y, Z: simetría ({axes}); Esc o el "
        "botón derecho cancela",
    "Move the lattice's points back to rest, where they deform nothing": "Devuelve los puntos de la jaula a donde no deforman nada",
    "Resolution": "Resolución",
    "Room between the objects and the lattice on each side, as a share of the lattice's largest side":
        "Espacio que queda a cada lado, como parte del lado mayor",
    "Say how far: displacement is missing": "Di cuánto: falta displacement",
    "Say where: vertex or location is missing": "Di dónde: falta vertex o location",
    "Say which object is pulled: the lattice deforms several": "Di de qué objeto se tira: la jaula deforma varios",
    "Select a lattice": "Selecciona una jaula",
    "Select a mesh, a curve, a surface, a text or a lattice":
        "Selecciona una malla, una curva, una superficie, un texto o una jaula",
    "Select an object that a lattice deforms": "Selecciona un objeto que una jaula deforme",
    "Select the vertices that the lattice shall deform": "Selecciona los vértices que la jaula ha de deformar",
    "A smooth and tight shape through the points": "Una forma suave y tensa por los puntos",
    "A smooth shape through the points": "Una forma suave por los puntos",
    "The smoothest shape, near the points, not through them": "La forma más suave, cerca de los puntos, no por ellos",
    "Straight lines from point to point": "Líneas rectas de punto a punto",
    "Remove fitted lattices: the objects get their shape without a lattice back, or keep the deformation":
        "Quita las jaulas ajustadas: los objetos quedan como estaban, o conservan la deformación",
    "Drag any point of a surface that a lattice deforms; the lattice's points move so that the point follows the mouse":
        "Agarra cualquier punto de lo que una jaula deforma; los puntos de la jaula siguen para que vaya con el ratón",
    "The modifier {modifier} of {object} is switched off in the viewport":
        "El modificador {modifier} de {object} está desactivado en la vista",
    "The shape of {object} is linked from another file: make it local first":
        "La forma de {object} está enlazada de otro archivo: hazla local antes",
    "The vertex group {group} of {object} is empty": "El grupo de vértices {group} de {object} está vacío",
    "This lattice deforms nothing": "Esta jaula no deforma nada",
    "Vertex group that was made for the vertices that the lattice deforms":
        "Grupo de vértices que se hizo para los vértices que la jaula deforma",
    "Interpolation between the lattice's points": "Interpolación entre los puntos de la jaula",
    "Parent the lattice to the object, if it deforms one object only, so that it moves along":
        "Emparentar la jaula al objeto, si deforma uno solo, para que se mueva con él",
    "Orientation of the lattice's axes": "Orientación de los ejes de la jaula",
    "At most {count} vertices can be held": "Se pueden retener {count} vértices como máximo",
    "{keyword} is not a list of whole numbers": "{keyword} no es una lista de números enteros",
    "{lattice} deforms {objects}": "{lattice} deforma {objects}",
    "{modifier} of {object} cannot be applied: {error}": "{modifier} de {object} no se puede aplicar: {error}",
    "{modifier} of {object} has no influence there": "{modifier} de {object} no tiene influencia ahí",
    "{objects} without a lattice": "{objects} sin jaula",
    "Of {objects} the control points keep the deformation: what lies between them can look different":
        "De {objects} los puntos de control conservan la deformación: lo que hay entre ellos puede verse distinto",
    "{other} of {object} acts before {modifier}, and would act on the applied shape afterwards: apply {other} first, or move "
    "{modifier} above it":
        "{other} de {object} actúa antes que {modifier}, y actuaría después sobre la forma aplicada: aplica primero {other}, o mueve "
        "{modifier} por encima",
    "{object} deforms nothing that is shown": "{object} no deforma nada que se muestre",
    "The lattice would be too large or too small for Blender": "La jaula sería demasiado grande o pequeña para Blender",
    "{object} has no geometry": "{object} no tiene geometría",
    "{object} has no lattice modifier {modifier}": "{object} no tiene el modificador de jaula {modifier}",
    "{object} has no shape that a lattice deforms: meshes, curves, surfaces, texts and lattices have":
        "{object} no tiene forma que una jaula deforme: la tienen mallas, curvas, superficies, textos y jaulas",
    "{object} has no surface that could be pulled": "{object} no tiene superficie de la que tirar",
    "{object} has no vertex {number}": "{object} no tiene el vértice {number}",
    "{object} has no vertices to choose from: only meshes have vertex groups":
        "{object} no tiene vértices que elegir: solo las mallas tienen grupos de vértices",
    "{object} has shape keys, to which nothing can be applied":
        "{object} tiene formas clave, a las que no se puede aplicar nada",
    "{object} has shape keys, which decide where its points are":
        "{object} tiene formas clave, que deciden dónde están sus puntos",
    "{object} has vertices at infinity": "{object} tiene vértices en el infinito",
    "{object} is a text, to which nothing can be applied: convert it to a mesh first":
        "{object} es un texto, al que no se puede aplicar nada: conviértelo antes en malla",
    "{object} is deformed by no lattice: fit one first": "A {object} no lo deforma ninguna jaula: ajusta una antes",
    "{object} is scaled to nothing along one of its axes": "{object} está escalado a nada en uno de sus ejes",
    "{object} shares its shape with other objects: make it a single user first":
        "{object} comparte su forma con otros objetos: hazla de un solo usuario antes",
}

OPERATORS = {
    "Apply": "Aplicar",
    "Fit Lattice": "Ajustar jaula",
    "Pull Lattice": "Tirar de la jaula",
    "Remove Lattice": "Quitar jaula",
    "Reset Lattice": "Restablecer jaula",
}
