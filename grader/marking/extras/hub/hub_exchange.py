"""nbgrader's exchange for a hub: submissions come from the students' inboxes, and feedback returns there.

Students use nbgrader's own exchange, each in a folder of their own. These classes are the teachers' side.
"""
import os
from pathlib import Path

from nbgrader.exchange import default
from traitlets import Unicode
from traitlets.config import Configurable

from grader.marking.extras.hub.inbox_import import import_submissions


class Inboxes(Configurable):
    """The folders of the students' inboxes."""

    folder = Unicode("", help="The folder with one folder for each student.").tag(config=True)


class ReleaseAssignment(default.ExchangeReleaseAssignment):  # type: ignore[misc]
    """Releases an assignment. nbgrader would let everyone write into the exchange first."""

    def ensure_root(self) -> None:
        """Check that the exchange can be written."""
        default.Exchange.ensure_root(self)


class CollectFromInboxes(default.ExchangeCollect):  # type: ignore[misc]
    """Collects submissions as nbgrader does, after they were taken out of the inboxes."""

    def init_src(self) -> None:
        """Find the submissions."""
        place = Path(self.root, self.coursedir.course_id, "inbound")
        folder = Path(Inboxes(parent=self).folder)
        for notice in import_submissions(folder, self.coursedir.course_id, place):
            self.log.warning(notice)
        super().init_src()


class ReleaseFeedbackToInboxes(default.ExchangeReleaseFeedback):  # type: ignore[misc]
    """Releases each student's feedback into the student's inbox, which no other student enters."""

    def copy_files(self) -> None:
        """Copy the pages of all chosen students."""
        chosen = self.coursedir.student_id
        folder = Path(Inboxes(parent=self).folder)
        try:
            for student in sorted(os.listdir(folder)):
                place = folder / student / self.coursedir.course_id / "feedback"
                if chosen in ("", "*", student) and place.is_dir():
                    self.coursedir.student_id = student
                    self.init_src()
                    self.dest_path = str(place)
                    super().copy_files()
        finally:
            self.coursedir.student_id = chosen
