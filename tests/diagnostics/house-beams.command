house house-beams.plan #1:0 --library all
