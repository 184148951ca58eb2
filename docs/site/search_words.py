"""Words by which readers look for a page, beside those that it uses: English and Spanish ones of each page that has some."""

WORDS = {
    "index": ("begin beginner tutorial example demo scenes", "empezar principiante tutorial ejemplo escenas"),
    "path": (
        "bank lean roll camera move train wagon carriage rail coaster speed constant velocity spline curve flip orbit car road aeroplane motion path",
        "peralte inclinar cámara tren vagón raíl velocidad constante curva avión coche",
    ),
    "layers": (
        "additive override mask bones blend mix action clip wave throw nla upper body",
        "aditiva máscara huesos mezclar acción saludo",
    ),
    "ik": (
        "inverse kinematics foot feet hand slide slip elbow knee snap pole angle target reach arm leg fk switch stretch rubber floor limits",
        "cinemática inversa pie pies mano deslizar rodilla polo ángulo objetivo brazo pierna estirar límites",
    ),
    "limited_chains": ("joint limits solver", "límites articulación"),
    "look_at": ("eyes eye head gaze blink aim neck spine saccades track", "ojos cabeza mirada parpadeo cuello apuntar"),
    "walker": (
        "walk cycle legs feet foot slide slip spider insect horse gait step stones terrain quadruped biped run creature",
        "caminar ciclo patas pies deslizar araña insecto caballo andares paso piedras terreno",
    ),
    "dynamics": (
        "overshoot follow through lag jiggle spring bounce wobble secondary motion overlap delay settle",
        "rebote muelle retardo gelatina inercia movimiento secundario",
    ),
    "chains": (
        "hair tail rope cloth cape ponytail wind collision collider collide physics jiggle antenna ears swing gravity simulation",
        "pelo cola cuerda tela capa viento colisión física orejas gravedad simulación",
    ),
    "tracks": ("record recording past", "grabar grabación"),
    "pull": (
        "sculpt grab pin soft selection falloff surface shape deform scan magnet drag vertex",
        "esculpir agarrar ancla superficie deformar escaneo arrastrar",
    ),
    "drivers": (
        "wiggle noise wave sine random flicker light property expression driver oscillate crowd",
        "ruido onda seno azar parpadeo luz propiedad expresión oscilar",
    ),
    "lattice": ("free form deformation ffd cage deform shape key face smile", "deformación libre ffd jaula cara sonrisa"),
    "snow": (
        "snowfall flakes particles rain dust petals sparks roof cover melt winter ground slow motion leaves",
        "nevada copos partículas polvo pétalos chispas tejado derretir invierno",
    ),
    "pendulums": ("pendulum double chaos swing clock spherical trail", "péndulo caos reloj"),
    "stereo": (
        "3d glasses anaglyph vr180 vr headset parallax interocular convergence eyes depth panorama 360",
        "gafas anaglifo vr180 realidad virtual paralaje convergencia profundidad 360",
    ),
    "chroma": (
        "green screen blue screen keying key despill matte spill compositor footage",
        "pantalla verde azul croma mate compositor filmación",
    ),
    "install": ("install uninstall remove update upgrade zip windows macos linux download enable", ""),
    "copying": ("copy paste settings other objects preset presets asset library", ""),
    "hand_over": (
        "export bake unity unreal maya fbx gltf usd alembic send share game engine without",
        "exportar procesar unity unreal maya fbx gltf usd alembic enviar compartir motor de juegos sin motus",
    ),
    "farm": ("render farm slurm deadline cluster network", ""),
    "together": ("bake order combine layers ik both keyframes apply", "procesar orden combinar claves aplicar granja de render"),
    "operators": ("python script bpy ops api keywords background", ""),
    "python": ("python module numpy api", ""),
    "library": ("c++ cmake link program", ""),
    "changes": ("release notes version new", ""),
}


def words(address):
    """Those of a page, by its address in the site."""
    name = address.removesuffix(".html")
    return WORDS.get(name.removeprefix("es/"), ("", ""))[name.startswith("es/")].split()
