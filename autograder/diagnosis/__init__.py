"""Why an answer is wrong: known mistakes by name, equivalent conventions, properties that broke, small witnesses."""
