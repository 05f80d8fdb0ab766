count house-costs.plan --library huts --by price
