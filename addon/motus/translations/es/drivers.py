"""Spanish: motion drivers."""

INTERFACE = {
    "Motion Drivers": "Controladores de movimiento",
    "Let a property swing, ease or wander by itself": "Hace que una propiedad oscile, avance suavemente o divague por sí sola",
    "Take a motion driver off a property, which keeps the value that it has":
        "Quita de una propiedad un controlador de movimiento; la propiedad conserva el valor que tiene",
    "Name of the object with the property; empty takes the active one":
        "Nombre del objeto que tiene la propiedad; vacío toma el activo",
    "ID Type": "Tipo de bloque",
    "Kind of a datablock that is no object, as driver targets name it, such as MATERIAL":
        "Tipo de un bloque de datos que no es objeto, con el nombre que le dan los objetivos de los controladores, como MATERIAL",
    "Name of that datablock": "Nombre de ese bloque de datos",
    "Data Path": "Ruta de datos",
    "Path of the property from the datablock; empty takes the property under the mouse":
        "Ruta de la propiedad desde el bloque de datos; vacía toma la propiedad bajo el ratón",
    "Component of an array; -1 takes all of them": "Componente de una lista; -1 los toma todos",
    "Replace": "Reemplazar",
    "Take the place of a driver that is there": "Ocupa el lugar de un controlador que ya esté ahí",
    "Edit Motion Driver": "Editar controlador de movimiento",
    "Motion": "Movimiento",
    "What moves the property": "Lo que mueve la propiedad",
    "Pendulum": "Péndulo",
    "Swing like a bob on a rod; the value is its angle": "Oscila como un peso en una varilla; el valor es su ángulo",
    "Double Pendulum": "Péndulo doble",
    "Swing like one of two bobs, the second of which hangs on the first: chaotic, and the same every time":
        "Oscila como uno de dos pesos, el segundo de los cuales cuelga del primero: caótico, y siempre igual",
    "Ease": "Suavizado",
    "Go from 0 to 1 with a soft start and a soft stop": "Va de 0 a 1 con un comienzo suave y un final suave",
    "Wander smoothly between -1 and 1": "Divaga suavemente entre -1 y 1",
    "Base": "Base",
    "Value that the motion is added to; the property's own where it is not given":
        "Valor al que se suma el movimiento; si no se indica, el de la propia propiedad",
    "Amplitude": "Amplitud",
    "What the motion is multiplied by": "Por cuánto se multiplica el movimiento",
    "Frame at which the time begins": "Fotograma en el que empieza el tiempo",
    "Angle at the start, from hanging down": "Ángulo al comienzo, medido desde la posición colgada",
    "Push": "Empujón",
    "Angular velocity at the start, per second": "Velocidad angular al comienzo, por segundo",
    "Of the rod: a long pendulum swings slowly": "De la varilla: un péndulo largo oscila despacio",
    "What of the double pendulum moves the property": "Qué del péndulo doble mueve la propiedad",
    "Upper Angle": "Ángulo superior",
    "Lower Angle": "Ángulo inferior",
    "Upper Velocity": "Velocidad superior",
    "Lower Velocity": "Velocidad inferior",
    "Angle of the upper rod": "Ángulo de la varilla superior",
    "Angle of the lower rod, from hanging down too":
        "Ángulo de la varilla inferior, también desde la posición colgada",
    "Angular velocity of the upper rod": "Velocidad angular de la varilla superior",
    "Angular velocity of the lower rod": "Velocidad angular de la varilla inferior",
    "Of the upper rod at the start, from hanging down": "De la varilla superior al comienzo, desde la posición colgada",
    "Of the lower rod at the start, from hanging down": "De la varilla inferior al comienzo, desde la posición colgada",
    "Upper Push": "Empujón superior",
    "Lower Push": "Empujón inferior",
    "Angular velocity of the upper rod at the start, per second":
        "Velocidad angular de la varilla superior al comienzo, por segundo",
    "Angular velocity of the lower rod at the start, per second":
        "Velocidad angular de la varilla inferior al comienzo, por segundo",
    "Upper Mass": "Masa superior",
    "Lower Mass": "Masa inferior",
    "Of the upper bob": "Del peso superior",
    "Of the lower bob": "Del peso inferior",
    "Upper Length": "Longitud superior",
    "Lower Length": "Longitud inferior",
    "Of the upper rod": "De la varilla superior",
    "Of the lower rod": "De la varilla inferior",
    "What pulls the bobs down": "Lo que tira de los pesos hacia abajo",
    "Damping": "Amortiguación",
    "Share of the velocity that is lost in a second": "Parte de la velocidad que se pierde en un segundo",
    "Of time; of noise about how often it goes up and down in a second":
        "Del tiempo; en el ruido, más o menos cuántas veces sube y baja en un segundo",
    "Frame with the value 0": "Fotograma con el valor 0",
    "Frame with the value 1": "Fotograma con el valor 1",
    "Fraction of the time in which the motion speeds up": "Fracción del tiempo en la que el movimiento acelera",
    "Fraction of the time in which the motion slows down": "Fracción del tiempo en la que el movimiento frena",
    "Seed": "Semilla",
    "Another number gives another noise": "Otro número da otro ruido",
    "{path} is driven by {function}": "{path} se mueve por {function}",
    "{path} has a driver already": "{path} ya tiene un controlador",
    "{path} has no motion driver": "{path} no tiene controlador de movimiento",
    "{path} is no number that can be driven": "{path} no es un número que se pueda controlar",
    "{path} has {count} components: index goes from 0 to {last}":
        "{path} tiene {count} componentes: el índice va de 0 a {last}",
    "{object} has no property {path}": "{object} no tiene la propiedad {path}",
    "Point at a property with the mouse, or give its data path":
        "Señala una propiedad con el ratón, o indica su ruta de datos",
    "There is no {name} of the type {type}": "No hay ningún {name} del tipo {type}",
    "There is no active object": "No hay ningún objeto activo",
}

OPERATORS = {
    "Add Motion Driver": "Añadir controlador de movimiento",
    "Edit Motion Driver": "Editar controlador de movimiento",
    "Remove Motion Driver": "Quitar controlador de movimiento",
}
