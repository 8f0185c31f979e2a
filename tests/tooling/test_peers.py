"""The comparison with ir-sim says plainly when there is nothing to compare with."""

from tests.bench import peers


def test_a_peer_that_cannot_be_installed_is_named_with_pips_reason(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(peers, "FOLDER", tmp_path / "peers")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", "")
    peers.main()
    assert capsys.readouterr().out == (
        "ir-sim==2.12.0 could not be installed, so there is nothing to compare with: "
        "ERROR: No matching distribution found for ir-sim==2.12.0\n"
    )
