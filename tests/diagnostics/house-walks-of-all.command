count house-walks-of-all.plan --library short
