import numpy as np
import pytest

from drivewright import contact
from drivewright.errors import InputError

pytestmark = pytest.mark.error


def test_a_hollow_narrower_than_the_body():
    with pytest.raises(InputError, match=r"0.01 and -0.0098 m give the relative curvature -2.04\d 1/m, which must be above 0"):
        contact.effective_radius(0.01, -0.0098)


def test_equal_hollow_and_body():
    with pytest.raises(InputError, match="concave ones negative and larger"):
        contact.effective_radius(0.01, -0.01)


@pytest.mark.parametrize("second", [(np.inf, np.inf), (np.inf, -0.03)])
def test_contact_along_a_line_or_at_two_places_is_no_point_contact(second):
    with pytest.raises(InputError, match="For 0 use line_contact"):
        contact.relative_radii((0.01, np.inf), second)


def test_radii_in_the_wrong_order():
    with pytest.raises(InputError, match="0.5, below 1; name the larger radius first"):
        contact.point_contact(10.0, (0.01, 0.02), 1e11)
