test house-tiles-cost.plan
