"""Spanish: pins."""

INTERFACE = {
    "Pin": "Ancla",
    "Pins rest in Edit Mode: the mesh is shown without them":
        "Las anclas descansan en el modo Edición: la malla se muestra sin ellas",
    "Move the root of a pin; a click makes the pin the active one":
        "Lleva la raíz de un ancla a otro lugar; un clic hace del ancla la activa",
    "Place in the world that the root is dragged to": "Lugar del mundo al que se arrastra la raíz",
    "Press the left mouse button on the handle of a pin and drag it; Esc or the right button cancels":
        "Pulsa el botón izquierdo del ratón sobre el control de un ancla y arrástralo; Esc o el botón derecho cancela",
    "{pin} does not pull now: it is muted, or its strength or the influence is 0":
        "{pin} no tira ahora: está silenciada, o su fuerza o la influencia es 0",
    "{object} is scaled to nothing in a direction": "{object} está escalado a nada en una dirección",
    "Motus Pins": "Anclas de Motus",
    "Name of the pin": "Nombre del ancla",
    "Share of the pin's displacement that the root moves; negative pushes":
        "Parte del desplazamiento del ancla que se mueve la raíz; negativa empuja",
    "Switch the pin off": "Desactiva el ancla",
    "How far the root goes at the strength 1, in the object": "Cuánto se mueve la raíz con fuerza 1, en el objeto",
    "Lowest height of moved vertices, in the object": "Altura mínima de lo que se mueve, en el objeto",
    "Largest height of moved vertices, in the object": "Altura máxima de lo que se mueve, en el objeto",
    "Position of the root in the mesh": "Posición de la raíz en la malla",
    "Anchor": "Marca",
    "Number by which the mesh marks the root; 0 if the mesh has no mark": "Número con que la malla marca la raíz; 0 donde no hay marca",
    "Index that the root had at the last evaluation": "Índice de la raíz cuando se vio por última vez",
    "How much all pins together move the mesh": "Cuánto mueven la malla todas las anclas juntas",
    "Pins move the points of a mesh, and this is none": "Las anclas mueven los puntos de una malla, y esto no lo es",
    "The mesh has a vertex whose position is not a finite number":
        "La malla tiene un vértice cuya posición no es un número finito",
    "Some pins have lost their place in the mesh and do nothing: bind them again":
        "Algunas anclas han perdido su lugar en la malla y no hacen nada: vuelve a fijarlas",
    "Some pins have a setting that is not a usable number, and do nothing":
        "Algunas anclas tienen un ajuste que no es un número utilizable, y no hacen nada",
    "The vertex group of some pins is gone, so that they do nothing":
        "El grupo de vértices de algunas anclas ya no existe, así que no hacen nada",
    "Pins have nothing to bake, for their strengths are keyed: apply them to shape keys instead":
        "Las anclas no tienen nada que capturar, pues sus fuerzas tienen claves: aplícalas a claves de forma",
    "The modifier of the pins was removed or applied: remove the pins, or put it back":
        "El modificador de las anclas se quitó o se aplicó: quita las anclas, o vuelve a ponerlo",
    "The modifier of the pins has to stand before those that make other vertices":
        "El modificador de las anclas tiene que estar antes de los que crean otros vértices",
    "This pin has lost its place: bind it to another vertex, or remove it":
        "Esta ancla ha perdido su lugar: fíjala a otro vértice, o quítala",
    "Several vertices may be the root of this pin: bind it to one of them":
        "Varios vértices pueden ser la raíz de esta ancla: fíjala a uno de ellos",
    "A setting of this pin is not a usable number": "Un ajuste de esta ancla no es un número utilizable",
    "Shape": "Forma",
    "Name of the mesh's attribute that stores the displacement of each vertex, for a pin that was made of a stroke; empty for a pin with a root":
        "Nombre del atributo de la malla que dice cuánto se desplaza cada vértice, si el ancla se hizo de un trazo; vacío para un tirón de una sola raíz",
    "The stroke did more than a pull at one root: a pin of it keeps the shape":
        "El trazo hizo más que un tirón de una sola raíz: un ancla de él guarda la forma",
    "The shape of some pins is gone from the mesh, so that they do nothing":
        "La forma de algunas anclas ya no está en la malla, así que no hacen nada",
    "The shape of this pin is gone from the mesh: remove the pin":
        "La forma de esta ancla ya no está en la malla: quita el ancla",
    "{pin} keeps the shape of a stroke and has no root": "{pin} guarda la forma de un trazo y no tiene raíz",
    "Pinned the last stroke on {object}": "Anclado el último trazo en {object}",
    "The vertex group of this pin is gone": "El grupo de vértices de esta ancla ya no existe",
    "Index of the pin; -1 means all of them": "Índice del ancla; -1 significa todas",
    "Add a pin: a pull in the object's list, which can be keyed, muted and removed":
        "Agrega un ancla: un tirón en la lista del objeto, que puede tener claves, silenciarse y quitarse",
    "Index of the root; -1 takes the vertex that is nearest to the location":
        "Índice de la raíz; -1 toma el vértice más cercano a la ubicación",
    "Place that is pulled, in the space that Unit names; without vertex and location the place of the 3D cursor":
        "Lugar del que se tira, en el mundo o en el objeto según Unidades; sin vértice ni posición, el del cursor 3D",
    "Displacement of the root, instead of the brush's direction and strength":
        "Cuánto se mueve la raíz, en lugar de la dirección y la fuerza del pincel",
    "From Last Pull": "Del último tirón",
    "Turn the last pull, or all of the last stroke, into a pin: the mesh goes back to what it was before":
        "Convierte el último tirón, o el último trazo entero, en un ancla: la malla vuelve a lo que era antes",
    "Pinned at vertex {index} of {object}": "Anclado en el vértice {index} de {object}",
    "The mesh has changed since the last pull, so that it cannot be taken out of it":
        "La malla ha cambiado desde el último tirón, así que no se puede deshacer en ella",
    "Remove a pin, and what it did to the mesh": "Quita un ancla, y lo que le hacía a la malla",
    "Remove all pins": "Quita todas las anclas",
    "Let a pin act earlier or later than others; the order matters if heights are limited":
        "Hace que un ancla actúe antes o después que otras, lo que cuenta donde las alturas están limitadas",
    "Let the pin act earlier": "Actuar antes",
    "Let the pin act later": "Actuar después",
    "Direction in which the item moves in the list": "Sentido en el que el elemento se mueve en la lista",
    "New index of the pin, instead of a direction": "Nuevo índice del ancla, en lugar de un sentido",
    "The pin is at the end of the list already": "El ancla ya está al final de la lista",
    "Add a pin like this one on the other side of the object, with a strength of its own":
        "Agrega un ancla como esta al otro lado del objeto, con una fuerza propia",
    "Axis of the object across which the pin is mirrored": "Eje del objeto a través del que se refleja el ancla",
    "Give a pin that has lost its root a new root: the vertex nearest to the old place, or a given one":
        "Da a un ancla que ha perdido su lugar el vértice más cercano, u otro, como raíz",
    "Index of the new root; -1 takes the vertex that is nearest to the location":
        "Índice de la nueva raíz; -1 toma el vértice más cercano a la ubicación",
    "Position of the new root, in the object; by default the position of the old root":
        "Posición de la nueva raíz, en el objeto; la de la antigua si no se indica",
    "Restore the modifier of the pins, in front of all other modifiers":
        "Vuelve a poner el modificador de las anclas, delante de todos los demás",
    "{object} has no pins": "{object} no tiene anclas",
    "{object} is overridden and has modifiers of the library, before which pins cannot come":
        "{object} es una redefinición y tiene modificadores de la biblioteca, antes de los que no pueden ir anclas",
    "Nothing was pulled yet": "Todavía no se ha tirado de nada",
    "The last pull was one of {object}": "El último tirón fue de {object}",
    "A pin has no view to pull towards: choose another direction or give a displacement":
        "Un ancla no tiene vista hacia la que tirar: elige otra dirección o da un desplazamiento",
    "A pin has no cursor to go along with: choose another direction or give a displacement":
        "Un ancla no tiene cursor con el que ir: elige otra dirección o da un desplazamiento",
    "The object is turned, and a pin's limits are along its own axes: choose Local as the unit":
        "El objeto está girado, y los límites de un ancla van por sus propios ejes: elige Local como unidad",
    "Make the deformation by the pins a part of the mesh, and remove the pins":
        "Hace que lo que hacen las anclas sea parte de la malla, y las quita",
    "Form that the pins are applied in": "Forma en la que se aplican las anclas",
    "Mesh": "Malla",
    "Move the vertices themselves, by the strengths of this frame":
        "Mueve los propios vértices, con las fuerzas de este fotograma",
    "One Shape Key": "Una clave de forma",
    "One shape key for all pins, by the strengths of this frame":
        "Una clave de forma para todas las anclas, con las fuerzas de este fotograma",
    "Shape Keys": "Claves de forma",
    "A shape key for each pin, whose value is keyed or driven as the strength was":
        "Una clave de forma por ancla, cuyo valor tiene las claves o el controlador que tenía la fuerza",
    "Limits act on each shape key by itself now, no longer on all pins together":
        "Los límites actúan ahora sobre cada clave de forma por separado, ya no sobre todas las anclas juntas",
    "The influence is animated: the shape keys have that of this frame":
        "La influencia está animada: las claves de forma tienen la de este fotograma",
    "Strips of the NLA move {pin}: its shape key has the strength of this frame":
        "Tiras del ANL mueven {pin}: su clave de forma tiene la fuerza de este fotograma",
    "The strength of {pin} is beyond what a shape key allows":
        "La fuerza de {pin} excede lo que permite una clave de forma",
    "The mesh of {object} is used by others too: make it single-user first":
        "Otros también usan la malla de {object}: hazla de un solo usuario primero",
    "The shape keys of {object} are absolute: make them relative first":
        "Las claves de forma de {object} son absolutas: hazlas relativas primero",
    "Basis": "Base",
    "All": "Todo",
    "There is no such pull pin": "No existe esa ancla",
    "Apply Pins": "Aplicar anclas",
}

OPERATORS = {
    "Add Pull Pin": "Agregar ancla",
    "Apply Pins": "Aplicar anclas",
    "Bind Pin Again": "Volver a fijar el ancla",
    "Drag Pin": "Arrastrar ancla",
    "Mirror Pin": "Reflejar ancla",
    "Move Pin": "Mover ancla",
    "Pin Last Pull": "Anclar el último tirón",
    "Remove Pull Pin": "Quitar ancla",
    "Restore Modifier": "Restaurar modificador",
}
