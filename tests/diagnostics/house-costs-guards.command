count house-costs-guards.plan --library huts --by price
