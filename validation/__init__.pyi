"""What `validation` offers, for type checkers and editors."""

from validation.benchmarks.judging.discrete import problems as problems
from validation.engine.offered import contact_filter as contact_filter
from validation.engine.offered import contact_law as contact_law
from validation.engine.offered import contact_solver as contact_solver
from validation.engine.offered import force_spectrum as force_spectrum
from validation.engine.offered import profile_spectrum as profile_spectrum
from validation.engine.offered import rolling_model as rolling_model
from validation.engine.offered import stiffness_model as stiffness_model
from validation.engine.offered import stiffness_of_surface as stiffness_of_surface
from validation.report.compared import to_figure as to_figure
from validation.report.contents import CASES as CASES
from validation.report.judged import Judgement as Judgement
from validation.report.judged import judge as judge
from validation.scenes.dynamic_wheel import WheelScene as WheelScene
from validation.scenes.dynamic_wheel import load_wheel_scene as load_wheel_scene
from validation.scenes.indentation import IndentationScene as IndentationScene
from validation.scenes.load import load_scene as load_scene
from validation.scenes.material import Material as Material
from validation.scenes.measured import MeasuredHeights as MeasuredHeights
from validation.scenes.measured_surface import measured as measured
from validation.scenes.rail import RailScene as RailScene
from validation.scenes.rolling import RollingScene as RollingScene
from validation.scenes.roughness import Roughness as Roughness
from validation.selection.compare import Comparison as Comparison
from validation.selection.compare import compare as compare
from validation.selection.exported import to_csv as to_csv
from validation.selection.exported import to_json as to_json
from validation.selection.summary import summary as summary

MODULES: dict[str, str]
