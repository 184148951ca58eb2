"""Spanish: snow that lies."""

INTERFACE = {
    "A surface has no faces, or an emitter no mesh: they are left out":
        "Una superficie no tiene caras, o un emisor no tiene malla: no cuentan",
    "A surface moves: flakes have landed where it is on the present frame":
        "Una superficie se mueve: los copos han caído donde está en el fotograma actual",
    "A setting of the cover is not a finite number": "Un ajuste del manto no es un número finito",
    "A thin veil in which single flakes show, blown off slopes":
        "Un velo fino en el que se ven copos sueltos, que el viento quita de las pendientes",
    "Add a mesh that snow is to lie on": "Agrega una malla sobre la que quede la nieve",
    "Add an emitter of snow that falls on the surfaces": "Agrega un emisor de nieve que caiga sobre las superficies",
    "Add the objects that are named, or the selected ones, to those that snow lies on or falls from":
        "Agrega los objetos nombrados, o los seleccionados, a aquellos sobre los que queda o de los que cae la nieve",
    "An emitter's motion, or the wind, is not known ahead, and counts as it is now: record it, or key it":
        "El movimiento de un emisor, o el viento, no se conoce de antemano y cuenta como es ahora: grábalo o ponle claves",
    "Deep Winter": "Pleno invierno",
    "Deepest": "Espesor máximo",
    "Dusting": "Nevada ligera",
    "Edge of the cube of snow that each flake that lands adds: with larger ones snow grows faster":
        "Arista del cubo de nieve que agrega cada copo que cae: con una mayor la nieve crece más deprisa",
    "Largest length of the edges of the layer, however large the faces are that it lies on":
        "Longitud máxima de las aristas del manto, por grandes que sean las caras sobre las que está",
    "Emitters": "Emisores",
    "Calculate where all flakes land, which takes some time for so many; then every frame is shown at once":
        "Calcular dónde caen todos los copos, que siendo tantos lleva su tiempo; después cada fotograma se ve al momento",
    "Flakes Land": "Los copos caen encima",
    "Grows fast into thick round cushions": "Crece deprisa en gruesos cojines redondos",
    "Share of the snow's depth that is shown: snow melts as it goes to 0":
        "Parte del espesor de la nieve que se muestra: se derrite al ir hacia 0",
    "It does not snow in this scene: add snow first": "En esta escena no nieva: agrega nieve primero",
    "Snow Layer": "Manto de nieve",
    "Let the flakes that land on the selected meshes stay there, as a layer of snow that grows":
        "Deja que los copos que caen sobre las mallas seleccionadas queden allí, como un manto de nieve que crece",
    "List": "Lista",
    "Loose snow, soft and even, that steep roofs shed": "Nieve suelta, suave y pareja, que cae de los tejados empinados",
    "Snow per Flake": "Nieve por copo",
    "Lying Snow": "Nieve caída",
    "Lying snow is computed on each frame: there is nothing to bake":
        "La nieve caída se calcula en cada fotograma: no hay nada que capturar",
    "Material": "Material",
    "Mesh object that snow lies on, or emitter of snow": "Objeto de malla sobre el que queda la nieve, o emisor de nieve",
    "More than 10 million flakes fall until the end: let fewer flakes fall, and raise Snow per Flake":
        "Hasta el final caen más de 10 millones de copos: deja caer menos, y sube Nieve por copo",
    "Name of a collection on whose meshes snow lies too": "Nombre de una colección sobre cuyas mallas también queda nieve",
    "Name of the snow cover; empty takes the active object": "Nombre del manto de nieve; vacío toma el objeto activo",
    "Name of the snow cover; empty takes the selected ones": "Nombre del manto de nieve; vacío toma los seleccionados",
    "Names of objects, between commas; empty takes the selected ones":
        "Nombres de objetos, entre comas; vacío toma los seleccionados",
    "Names of the emitters of snow, between commas; empty takes the selected ones, or all of the scene":
        "Nombres de los emisores de nieve, entre comas; vacío toma los seleccionados, o todos los de la escena",
    "Names of the mesh objects that snow lies on, between commas; empty takes the selected ones":
        "Nombres de los objetos de malla sobre los que queda la nieve, entre comas; vacío toma los seleccionados",
    "None of the surfaces has faces": "Ninguna de las superficies tiene caras",
    "Nothing is selected that is not in the list": "No hay nada seleccionado que no esté en la lista",
    "Index of the object in the list; -1 for the last one": "Índice del objeto en la lista; -1 para el último",
    "Material of the lying snow": "Material de la nieve caída",
    "Powder": "Nieve polvo",
    "Reads": "Lee",
    "Removed {objects}": "Se ha quitado {objects}",
    "How far snow spreads to what lies beside it": "Hasta dónde la nieve se extiende sobre lo de al lado",
    "Select the meshes that snow is to lie on": "Selecciona las mallas sobre las que quede la nieve",
    "Slope": "Pendiente",
    "Smoothing": "Suavizado",
    "Snow Cover": "Manto de nieve",
    "Snow Cover Presets": "Preajustes de manto de nieve",
    "Snow cannot lie on {object}": "La nieve no puede quedar sobre {object}",
    "Snow lies on the meshes of this collection too": "La nieve queda también sobre las mallas de esta colección",
    "Snow lies where it lands on slopes up to this angle; the steeper the more of it slides down":
        "En pendientes hasta este ángulo la nieve queda donde cae; cuanto más empinado, más resbala",
    "Snow that is thinner is hidden, so that the surface shows between the first flakes":
        "La nieve más fina no se ve, de modo que la superficie asoma entre los primeros copos",
    "So many flakes, or faces, take some time: press Calculate Snow":
        "Tantos copos, o caras, llevan su tiempo: pulsa Calcular nieve",
    "Sticks in heaps to all that is not quite upright": "Se pega en montones a todo lo que no es vertical",
    "Surfaces": "Superficies",
    "Take an object off the list": "Quita un objeto de la lista",
    "Take lying snow away; surfaces and falling snow stay":
        "Quita la nieve caída; las superficies y la nieve que cae se quedan",
    "Let flakes of emitters that have no collider land on all the surfaces and on the collection":
        "Deja que los copos de los emisores sin obstáculo caigan sobre todas las superficies y la colección",
    "The layer would have more than 2 million vertices: choose a coarser resolution, or fewer surfaces":
        "El manto tendría más de 2 millones de vértices: elige una resolución más gruesa, o menos superficies",
    "Snow spreads less far than Smoothing says, as the layer has so many vertices: choose a coarser resolution":
        "La nieve se extiende menos de lo que dice Suavizado, porque el manto tiene muchos vértices: elige una resolución más gruesa",
    "The list has no such object": "La lista no tiene ese objeto",
    "The object is in the library's list, and cannot be removed": "El objeto está en la lista de la biblioteca y no se puede quitar",
    "There is nothing to calculate": "No hay nada que calcular",
    "Thinnest": "Espesor mínimo",
    "This is no snow cover": "Esto no es un manto de nieve",
    "Emitters that snow falls from": "Emisores de los que cae la nieve",
    "Surfaces that snow lies on": "Superficies sobre las que queda la nieve",
    "Objects that the solver waits for, to notice changes": "Objetos que espera el cálculo, para notar cambios",
    "List that the objects are added to or removed from": "Lista a la que se agregan o de la que se quitan los objetos",
    "{object} is no emitter of snow": "{object} no es un emisor de nieve",
}

OPERATORS = {
    "Add Selected": "Agregar selección",
    "Add Snow Cover": "Agregar manto de nieve",
    "Add Snow Cover Preset": "Agregar preajuste de manto de nieve",
    "Add to Snow Cover": "Agregar al manto de nieve",
    "Remove Snow Cover": "Quitar manto de nieve",
    "Remove from Snow Cover": "Quitar del manto de nieve",
    "Use Snow Cover Preset": "Usar preajuste de manto de nieve",
    "Calculate Snow": "Calcular nieve",
}
