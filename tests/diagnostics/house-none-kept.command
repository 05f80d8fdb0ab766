sample house-none-kept.plan 3 --library short --max-houses 5
