enumerate search-undecided.plan --max-states 20 --max-conflicts 10
