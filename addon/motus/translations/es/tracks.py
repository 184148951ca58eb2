"""Spanish: inputs over time."""

INTERFACE = {
    "Go through the frames and keep in the file the motion that cannot be read from keys, such as that of constraints":
        "Recorrer los fotogramas y guardar en el archivo el movimiento que no se puede leer de las claves, como el de las restricciones",
    "Remove the recorded samples from the file": "Quitar del archivo las muestras grabadas",
    "Header": "Cabecera",
    "Times at which the samples were taken, and their source": "Momentos en que se tomaron las muestras, y su origen",
    "Data": "Datos",
    "The samples": "Las muestras",
    "Datablock": "Bloque de datos",
    "Name of the object or other datablock; empty takes the active object":
        "Nombre del objeto u otro bloque de datos; vacío toma el objeto activo",
    "Collection": "Colección",
    "Collection of the file that the datablock is in, such as materials":
        "Colección del archivo en la que está el bloque de datos, como materials",
    "Name of a bone; empty means the object itself": "Nombre de un hueso; vacío significa el propio objeto",
    "Transform": "Transformación",
    "Transform that is recorded if no data path is given": "Transformación que se graba si no se da una ruta de datos",
    "World Matrix": "Matriz de mundo",
    "World matrix, with parents and constraints": "Matriz en el mundo, con padres y restricciones",
    "Own Transform": "Transformación propia",
    "Location, rotation and scale of its own, without parents and constraints":
        "Posición, rotación y escala propias, sin padres ni restricciones",
    "Data Path": "Ruta de datos",
    "Path of a property from the datablock":
        "Ruta de una propiedad del bloque de datos; vacío significa una transformación",
    "Index": "Índice",
    "Index of a number in an array property; -1 for a property that is no array, or all":
        "Índice de un número en una propiedad de varios; -1 si la propiedad es un solo número",
    # Why something is not known ahead
    "{thing} has the constraint {name}": "{thing} tiene la restricción {name}",
    "a driver on {thing} sets {path}": "un controlador de {thing} fija {path}",
    "the constraint {name} of {bone} turns {thing}": "la restricción {name} de {bone} gira {thing}",
    "{thing} is a rigid body": "{thing} es un cuerpo rígido",
    "{thing} hangs on vertices of {name}": "{thing} cuelga de vértices de {name}",
    "{thing} is led along the curve {name}": "{thing} es llevado por la curva {name}",
    "NLA strips of {thing} are mixed in a way that is not known ahead":
        "Las tiras del ANL de {thing} se mezclan de un modo que no se sabe de antemano",
    "{name} drives {thing} by a part alone: its influence is not always 1":
        "{name} mueve {thing} solo en parte: su influencia no es siempre 1",
    "the shape of {name} changes, on which {thing} goes": "cambia la forma de {name}, por donde va {thing}",
    "{thing} hangs on itself": "{thing} cuelga de sí mismo",
    "{thing} changes its rotation mode": "{thing} cambia de modo de rotación",
    # What the panel says
    "Exact at any frame: read from keys": "Exacto en cualquier fotograma: se lee de las claves",
    "Exact at any frame: solved by {systems}": "Exacto en cualquier fotograma: lo resuelve {systems}",
    "Recorded {start}-{end} by steps of {step}; beyond, the first and last value hold":
        "Grabado {start}-{end} en pasos de {step}; fuera valen el primer y el último valor",
    "Needs recording: {reason}": "Hay que grabarlo: {reason}",
    "{recorded}; it may be out of date": "{recorded}; puede estar anticuado",
    # Reports
    "{object} has no number {path}": "{object} no tiene ningún número {path}",
    "There is no {object} in {collection}": "No hay ningún {object} en {collection}",
    "Only objects and bones have a transform: give a data path":
        "Solo los objetos y los huesos tienen transformación: da una ruta de datos",
    "Recorded {frames} frames of {object}: {size} KB": "Grabados {frames} fotogramas de {object}: {size} KB",
    "{object} is known at any frame: there is nothing to record":
        "{object} se conoce en cualquier fotograma: no hay nada que grabar",
    "{count} samples are too many for a file: {most} at most":
        "{count} muestras son demasiadas para un archivo: {most} como mucho",
    "Nothing was recorded of {object}": "No se ha grabado nada de {object}",
}

OPERATORS = {
    "Record": "Grabar",
    "Clear Recording": "Borrar la grabación",
}
