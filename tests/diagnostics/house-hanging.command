house house-hanging.plan #3:0 --library all
