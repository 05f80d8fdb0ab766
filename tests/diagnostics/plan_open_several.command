explain plan_open_several.plan 2m|cafe
