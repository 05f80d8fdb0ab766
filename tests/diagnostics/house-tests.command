test house-tests.plan
