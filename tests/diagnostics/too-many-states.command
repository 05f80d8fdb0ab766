count too-many-states.plan
