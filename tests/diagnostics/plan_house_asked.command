complete plan_house_asked.plan [2m|cafe;gable]
