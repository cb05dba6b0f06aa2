"""nbgrader: a course folder whose source notebook grades itself, and feedback pages in nbgrader's tree."""
