"""What `validation` offers, for type checkers and editors."""

from validation.advice.compare import Comparison as Comparison
from validation.advice.compare import compare as compare
from validation.advice.exported import to_csv as to_csv
from validation.advice.exported import to_json as to_json
from validation.advice.figure import to_figure as to_figure
from validation.advice.summary import summary as summary
from validation.advice.tolerance import Tolerance as Tolerance
from validation.analysis.evidence import Verdict as Verdict
from validation.benchmarks.discrete import KnownContact as KnownContact
from validation.benchmarks.discrete import problems as problems
from validation.judging.judge import Judgement as Judgement
from validation.judging.judge import judge as judge
from validation.judging.judgement import JudgedNumber as JudgedNumber
from validation.judging.judgement import JudgedRange as JudgedRange
from validation.judging.registry import contact_filter as contact_filter
from validation.judging.registry import contact_law as contact_law
from validation.judging.registry import contact_solver as contact_solver
from validation.judging.registry import force_spectrum as force_spectrum
from validation.judging.registry import interface_model as interface_model
from validation.judging.registry import profile_spectrum as profile_spectrum
from validation.judging.registry import rolling_model as rolling_model
from validation.judging.registry import stiffness_model as stiffness_model
from validation.judging.registry import stiffness_of_surface as stiffness_of_surface
from validation.railway.scenes.rail import RailScene as RailScene
from validation.report.contents import CASES as CASES
from validation.scenes.dynamic_wheel import WheelScene as WheelScene
from validation.scenes.dynamic_wheel import load_wheel_scene as load_wheel_scene
from validation.scenes.indentation import IndentationScene as IndentationScene
from validation.scenes.load import load_scene as load_scene
from validation.scenes.material import Material as Material
from validation.scenes.measured_heights import MeasuredHeights as MeasuredHeights
from validation.scenes.measured_surface import measured as measured
from validation.scenes.rolling import RollingScene as RollingScene
from validation.scenes.roughness import Roughness as Roughness

MODULES: dict[str, str]
