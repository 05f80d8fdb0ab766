enumerate search-too-large.plan --max-states 20 --max-gates 30
