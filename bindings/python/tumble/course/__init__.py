"""The assignment as files to hand out: ``python3 -m tumble.course new DIR``."""

from tumble.course.write import FILES, template_path, write_assignment

__all__ = ["FILES", "template_path", "write_assignment"]
