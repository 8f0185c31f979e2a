from sim.view.animation import MovingPicture


def test_a_moving_picture_is_shown_as_png_and_named_in_few_words():
    picture = MovingPicture(b"x" * 2048)
    assert picture._repr_png_() == b"x" * 2048
    assert repr(picture) == "<MovingPicture of 2 KiB>"
