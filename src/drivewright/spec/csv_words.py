"""Names of quantities in headings of other languages: German, French, Italian, Spanish, Chinese.  Accents and capitals do not count.

A word stands here where it means one quantity of a data file; what the unit of the column then says is checked besides.
"""

ANGLE = ("Winkel", "Drehwinkel", "Rotationswinkel", "angle de rotation", "angolo", "angolo di rotazione", "ángulo", "ángulo de giro")
ANGLE += ("角度", "转角", "旋转角")
CAM_ANGLE = ("Nockenwinkel", "Nockenwellenwinkel", "angle de came", "angle d'arbre à cames", "angolo camma", "angolo della camma")
CAM_ANGLE += ("ángulo de leva", "ángulo de la leva", "凸轮转角", "凸轮角度", "凸轮轴转角")
CRANK_ANGLE = ("crank angle", "crankshaft angle", "crank", "Kurbelwinkel", "Kurbelwellenwinkel", "Grad KW", "angle de vilebrequin")
CRANK_ANGLE += ("angle vilebrequin", "angle de manivelle", "angolo di manovella", "angolo manovella", "ángulo de cigüeñal")
CRANK_ANGLE += ("ángulo del cigüeñal", "ángulo de manivela", "曲轴转角", "曲柄转角", "曲柄角")
LIFT = ("Hub", "Ventilhub", "Nockenhub", "Stößelhub", "Erhebung", "Nockenerhebung", "levée", "levée de came", "levée de soupape")
LIFT += ("alzata", "alzata camma", "alzata valvola", "elevación", "alzada", "升程", "气门升程", "凸轮升程")
TIME = ("Zeit", "temps", "tempo", "tiempo", "时间")
TORQUE = ("Drehmoment", "Moment", "couple", "coppia", "momento torcente", "par", "par motor", "转矩", "扭矩", "力矩")
FORCE = ("Kraft", "forza", "fuerza", "力", "载荷")
TRAVEL = ("Weg", "Verschiebung", "course", "déplacement", "corsa", "spostamento", "carrera", "desplazamiento", "位移", "行程")
SPEED = ("Drehzahl", "Winkelgeschwindigkeit", "vitesse de rotation", "vitesse angulaire", "velocità angolare", "velocità di rotazione")
SPEED += ("velocidad angular", "velocidad de giro", "转速", "角速度")
VELOCITY = ("Geschwindigkeit", "vitesse", "velocità", "velocidad", "速度")
FACTOR = ("Faktor", "facteur", "fattore", "因子", "系数")
