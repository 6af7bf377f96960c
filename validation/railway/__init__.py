"""A wheel on a real rail."""

COMMANDS = {"sound": "write what a wheel on a rail sounds like by each model, as WAV files with one gain"}
BRINGS = {
    "scene": "validation.railway.scenes.rail_file:RailReader",
    "scenes": "validation.railway.scenes",
    "quantities": "validation.railway.scenes.rail:QUANTITIES",
    "exports": "validation.railway.options:CNOSSOS",
    "edge_scenes": "validation.railway.cases.edge_scenes:EDGES",
    "questions": "validation.railway.front_page:QUESTIONS",
    "alternatives": "validation.railway.front_page:ALTERNATIVES",
    "front_page": "validation.railway.front_page",
}
